#pragma once

#include <cstdint>

namespace vellus::scene {

/// The one clock of the simulation: every frame lasts `dt` seconds. Resource, set by the host.
struct FixedStep {
    double dt = 1.0 / 60.0;
    uint64_t frame = 0;
    uint64_t seed = 0;

    /// Seconds at the start of this frame.
    [[nodiscard]] double time() const { return dt * static_cast<double>(frame); }
};

}  // namespace vellus::scene
