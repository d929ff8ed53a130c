#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::groom_tool {

/// What a subcommand does once its options are read; prints its answer to `out`.
using Action = std::function<Result<void>(std::ostream& out)>;

/// One subcommand, in a file of its own: `attach` adds its options to `app` and returns what it
/// does with them.
struct Command {
    const char* name;
    const char* help;
    Action (*attach)(CLI::App& app);
};

extern const Command kInfo;
extern const Command kConvert;
extern const Command kGenerate;
extern const Command kCards;
extern const Command kView;

/// All of them, in the order of --help. A new one is one file and one line in program.cpp.
std::span<const Command* const> commands();

/// Hands an option's text to `read`; what it does not like becomes CLI11's error for that option.
template <class Read>
std::function<void(const std::string&)> reading(const char* option, Read read) {
    return [option, read](const std::string& text) {
        if (auto done = read(text); !done) {
            throw CLI::ValidationError(option, done.error().message());
        }
    };
}

/// "1,2.5,-3": exactly `count` numbers.
Result<std::vector<float>> read_numbers(const std::string& text, size_t count);

/// Adds an option that takes `count` numbers between commas and hands them to `take`.
CLI::Option* add_numbers(CLI::App& app, const char* name, size_t count, const char* help,
                         std::function<void(const std::vector<float>&)> take);

}  // namespace vellus::groom_tool
