#pragma once

#include <iosfwd>

#include "game_demo/src/options.h"

namespace vellus::demo {

/// What vellus_reference is asked for; scene, size, dt, seed and techniques mean what they mean for
/// the demo.
struct ReferenceOptions {
    Options content;
    std::filesystem::path out = "reference.exr";
    std::filesystem::path png;  ///< empty: none
    uint32_t samples = 64;      ///< per pixel
    uint32_t frame = 0;         ///< the demo's frame of that number
    uint32_t depth = 0;         ///< most scattering events; 0: no limit
};

/// As parse_options.
struct ParsedReferenceOptions {
    ReferenceOptions options;
    std::optional<int> exit_status;
};
ParsedReferenceOptions parse_reference_options(int argc, const char* const* argv, std::ostream& out,
                                               std::ostream& err);

}  // namespace vellus::demo
