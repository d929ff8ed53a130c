#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "game_demo/src/viewer.h"

namespace vellus::demo {

/// What the user decided, by key or in a panel; both change the same fields.
struct DemoState {
    bool paused = false;
    bool step = false;  ///< one frame although paused
    bool turntable = false;
    bool panels = false;
    bool accuracy = false;  ///< chart of error against time
    bool help = false;
    double speed = 1.0;  ///< of the simulation's clock
    CameraMode camera = CameraMode::kScene;
    std::optional<double> hour;        ///< time of day to go to
    std::optional<size_t> open_scene;  ///< index into `scenes`
    std::vector<std::filesystem::path> scenes;
    size_t scene = 0;  ///< the open one
};

/// What the last frames took.
struct FrameTimes {
    static constexpr size_t kCount = 120;
    std::array<float, kCount> milliseconds{};
    size_t next = 0;

    void add(double seconds) {
        milliseconds[next] = static_cast<float>(1e3 * seconds);
        next = (next + 1) % kCount;
    }
    [[nodiscard]] float last() const { return milliseconds[(next + kCount - 1) % kCount]; }
};

}  // namespace vellus::demo
