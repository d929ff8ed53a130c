#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame_graph/execute.h"
#include "engine/gpu/device.h"

namespace vellus::demo {

/// One line of the effect plan: what a groom is drawn with on an axis, and why.
struct EffectRow {
    std::string groom;
    std::string axis;
    std::string technique;
    std::string reason;
};

/// What one frame cost, all of it waited for. Times in milliseconds.
struct FrameStats {
    uint32_t index = 0;
    double cpu_ms = 0.0;   ///< process CPU time of all threads
    double wall_ms = 0.0;  ///< from the first system to the device's last write
    graph::FrameReport report;
    std::vector<EffectRow> effects;

    /// Wall time that no pass took: systems, compilation, submission.
    [[nodiscard]] double unattributed_ms() const;
};

struct RunStats {
    gpu::DeviceTraits device;
    std::string scene;
    uint64_t seed = 0;
    std::array<uint32_t, 2> size{};
    uint64_t hash = 0;  ///< FNV-1a of the last image's RGBA8 bytes
    std::vector<FrameStats> frames;
};

/// stats.json, version 1.
std::string to_json(const RunStats& stats);

}  // namespace vellus::demo
