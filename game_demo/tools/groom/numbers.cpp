#include <charconv>
#include <cmath>

#include "game_demo/tools/groom/command.h"

namespace vellus::groom_tool {

Result<std::vector<float>> read_numbers(const std::string& text, size_t count) {
    std::vector<float> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (numbers.size() < count) {
        float number = 0.0f;
        const auto [next, code] = std::from_chars(at, end, number);
        if (code != std::errc{} || !std::isfinite(number)) break;
        numbers.push_back(number);
        at = next;
        if (at == end || *at != ',') break;
        ++at;
    }
    if (numbers.size() == count && at == end) return numbers;
    return Error{fmt::format("'{}' is not {} numbers", text, count), "",
                 "put commas between them, e.g. 0,1.6,0"};
}

CLI::Option* add_numbers(CLI::App& app, const char* name, size_t count, const char* help,
                         std::function<void(const std::vector<float>&)> take) {
    return app.add_option_function<std::string>(
        name,
        reading(name,
                [count, take = std::move(take)](const std::string& text) -> Result<void> {
                    auto numbers = read_numbers(text, count);
                    if (!numbers) return numbers.error();
                    take(*numbers);
                    return {};
                }),
        help);
}

}  // namespace vellus::groom_tool
