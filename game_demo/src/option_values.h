#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "game_demo/src/options.h"

namespace vellus::demo {

constexpr uint32_t kMaxSide = 16384;
constexpr uint32_t kMaxFrames = 1'000'000;

// Each reads one option's text; an Error says what the text is and what it may be.

/// "1280x720".
Result<std::array<uint32_t, 2>> read_size(std::string_view text);
/// Seconds, 0 to 10.
Result<double> read_seconds(std::string_view text);
/// "all", "last" or "0,5,31".
Result<SaveChoice> read_save(std::string_view text);
/// "shadow=none"; axis and technique are those of the hair module.
Result<TechniqueChoice> read_technique(std::string_view text);
/// "no_culling", "random_order=7" and so on, into `switches`.
Result<void> read_switch(std::string_view text, graph::Switches& switches);
/// Parses, then checks what no single option can see (`check` throws CLI::ValidationError). The
/// program's exit status where there is nothing to run: 0 after --help, 2 after a mistake.
std::optional<int> parse_or_tell(CLI::App& app, int argc, const char* const* argv,
                                 const std::function<void()>& check, std::ostream& out,
                                 std::ostream& err);

/// The legal values, for --help.
std::string describe_techniques();
std::string switch_names();

}  // namespace vellus::demo
