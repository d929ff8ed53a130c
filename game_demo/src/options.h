#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame_graph/compile.h"

namespace vellus::demo {

/// Which frames become pictures.
struct SaveChoice {
    enum class Kind : uint8_t { kLast, kAll, kListed };
    Kind kind = Kind::kLast;
    std::vector<uint32_t> frames;  ///< kListed: sorted

    /// Whether frame `index` of `count` is kept.
    [[nodiscard]] bool keeps(uint32_t index, uint32_t count) const;
};

/// `--set AXIS=TECHNIQUE`: holds for every groom of the scene.
struct TechniqueChoice {
    std::string axis;
    std::string technique;
};

struct Options {
    std::filesystem::path scene;  ///< empty: the default scene
    bool headless = false;
    uint32_t frames = 0;  ///< 0 in a window: until it is closed
    uint32_t warmup = 0;  ///< frames drawn before the first that counts
    std::array<uint32_t, 2> size{1280, 720};
    std::filesystem::path out = "out";
    SaveChoice save;
    double dt = 1.0 / 60.0;
    bool real_time = true;  ///< in a window, without --dt: the clock's seconds instead of dt
    uint64_t seed = 0;
    std::string device;
    std::vector<TechniqueChoice> techniques;
    graph::Switches switches;
    bool validation = false;
    bool no_taa = false;
    bool explain = false;
    std::optional<double> budget_ms;  ///< techniques are picked so that a frame takes that long
    std::filesystem::path accuracy;   ///< table to pick by; empty: the one that came along
    bool list_devices = false;
};

/// Options, or the program's exit status where there is nothing to run: 0 after --help, 2 after a
/// mistake, which `err` then names with the option and what it may be.
struct ParsedOptions {
    Options options;
    std::optional<int> exit_status;
};
ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err);

}  // namespace vellus::demo
