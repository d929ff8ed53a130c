#include "game_demo/tools/groom/program.h"

#include <array>
#include <exception>
#include <memory>
#include <ostream>
#include <vector>

#include "game_demo/tools/groom/command.h"

namespace vellus::groom_tool {

std::span<const Command* const> commands() {
    static constexpr std::array<const Command*, 5> kAll = {&kInfo, &kConvert, &kGenerate, &kCards,
                                                           &kView};
    return kAll;
}

int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err) try {
    CLI::App app("Looks at hair grooms, converts them and grows new ones.", "vellus_groom");
    app.footer("vellus_groom COMMAND --help explains each command.");
    app.require_subcommand(1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    Action chosen;
    for (const Command* command : commands()) {
        CLI::App* sub = app.add_subcommand(command->name, command->help);
        sub->callback([&chosen, action = command->attach(*sub)] { chosen = action; });
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        const auto subs = app.get_subcommands();
        out << (subs.empty() ? app.help() : subs.front()->help("", CLI::AppFormatMode::Normal));
        return 0;
    } catch (const CLI::ParseError& error) {
        err << "error: " << error.what() << " (see --help)\n";
        return 2;
    }
    if (auto done = chosen(out); !done) {
        err << "error: " << done.error().message() << '\n';
        return 1;
    }
    return 0;
} catch (const std::exception& exception) {
    err << "error: " << exception.what() << '\n';
    return 1;
}

}  // namespace vellus::groom_tool
