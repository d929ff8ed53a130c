#include "game_demo/src/option_values.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>

#include "modules/hair/techniques.h"

namespace vellus::demo {

namespace {

template <class Number>
std::optional<Number> read_number(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

template <class Range>
std::string joined(const Range& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

struct NamedSwitch {
    std::string_view name;
    bool graph::Switches::*flag;
};
constexpr std::array kSwitches = {
    NamedSwitch{"no_culling", &graph::Switches::no_culling},
    NamedSwitch{"no_aliasing", &graph::Switches::no_aliasing},
    NamedSwitch{"full_barriers", &graph::Switches::full_barriers},
    NamedSwitch{"random_order", &graph::Switches::random_order},
    NamedSwitch{"poison", &graph::Switches::poison},
    NamedSwitch{"immediate", &graph::Switches::immediate},
};

}  // namespace

bool SaveChoice::keeps(uint32_t index, uint32_t count) const {
    switch (kind) {
        case Kind::kAll:
            return true;
        case Kind::kLast:
            return index + 1 == count;
        case Kind::kListed:
            return std::ranges::binary_search(frames, index);
    }
    return false;
}

Result<std::array<uint32_t, 2>> read_size(std::string_view text) {
    const size_t cross = text.find('x');
    if (cross != std::string_view::npos) {
        const auto width = read_number<uint32_t>(text.substr(0, cross));
        const auto height = read_number<uint32_t>(text.substr(cross + 1));
        const auto legal = [](auto side) { return side && *side >= 1 && *side <= kMaxSide; };
        if (legal(width) && legal(height)) return std::array{*width, *height};
    }
    return Error{fmt::format("'{}' is no size", text), "",
                 fmt::format("WIDTHxHEIGHT, each 1 to {}, e.g. 1280x720", kMaxSide)};
}

Result<double> read_seconds(std::string_view text) {
    const auto seconds = read_number<double>(text);
    if (seconds && *seconds >= 0.0 && *seconds <= 10.0) return *seconds;
    return Error{fmt::format("'{}' is no time step", text), "", "seconds, 0 to 10"};
}

Result<SaveChoice> read_save(std::string_view text) {
    if (text == "all") return SaveChoice{SaveChoice::Kind::kAll, {}};
    if (text == "last") return SaveChoice{SaveChoice::Kind::kLast, {}};
    SaveChoice choice{SaveChoice::Kind::kListed, {}};
    for (std::string_view rest = text;;) {
        const size_t comma = rest.find(',');
        const auto index = read_number<uint32_t>(rest.substr(0, comma));
        if (!index) {
            return Error{fmt::format("'{}' says no frames", text), "",
                         "all, last, or frame numbers such as 0,5,31"};
        }
        choice.frames.push_back(*index);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    std::ranges::sort(choice.frames);
    return choice;
}

Result<TechniqueChoice> read_technique(std::string_view text) {
    const size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
        return Error{fmt::format("'{}' is not AXIS=TECHNIQUE", text), "", describe_techniques()};
    }
    TechniqueChoice choice{std::string(text.substr(0, equals)),
                           std::string(text.substr(equals + 1))};
    hair::HairTechniques scratch;
    if (auto set = hair::set_technique(scratch, choice.axis, choice.technique); !set) {
        return Error{set.error().what, "", set.error().remedy};
    }
    return choice;
}

Result<void> read_switch(std::string_view text, graph::Switches& switches) {
    const size_t equals = text.find('=');
    const std::string_view name = text.substr(0, equals);
    const auto* row = std::ranges::find(kSwitches, name, &NamedSwitch::name);
    const bool seeded = equals != std::string_view::npos;
    if (row == kSwitches.end() || (seeded && name != "random_order")) {
        return Error{fmt::format("no such switch '{}'", text), "", "one of: " + switch_names()};
    }
    if (seeded) {
        const auto seed = read_number<uint64_t>(text.substr(equals + 1));
        if (!seed) return Error{fmt::format("'{}' has no seed", text), "", "random_order=7"};
        switches.seed = *seed;
    }
    switches.*row->flag = true;
    return {};
}

std::string describe_techniques() {
    std::vector<std::string> lines;
    for (const std::string_view axis : hair::axes()) {
        lines.push_back(fmt::format("{}={}", axis, fmt::join(hair::technique_ids(axis), "|")));
    }
    return joined(lines);
}

std::string switch_names() {
    std::vector<std::string> names;
    for (const NamedSwitch& row : kSwitches) {
        names.emplace_back(row.name);
        if (row.name == "random_order") names.back() += "[=SEED]";
    }
    return joined(names);
}

std::optional<int> parse_or_tell(CLI::App& app, int argc, const char* const* argv,
                                 const std::function<void()>& check, std::ostream& out,
                                 std::ostream& err) {
    try {
        app.parse(argc, argv);
        check();
    } catch (const CLI::CallForHelp&) {
        out << app.help();
        return 0;
    } catch (const CLI::ParseError& error) {
        err << "error: " << error.what() << " (see --help)\n";
        return 2;
    }
    return std::nullopt;
}

}  // namespace vellus::demo
