#pragma once

#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "game_demo/src/accuracy/budget.h"
#include "game_demo/tools/accuracy/radiance.h"
#include "game_demo/tools/accuracy/studio.h"

namespace vellus::demo {

/// How a run of frames is drawn.
struct FrameRun {
    StudioLook look;
    uint32_t size = 0;
    uint32_t warm_up = 0;
    uint32_t frames = 0;
    bool temporal = true;
    float blend = 0.06f;  ///< share of a frame in the history; 1: each stands alone
    /// What differs from the demo's defaults.
    std::vector<AxisChoice> choices;
    uint64_t seed = 0;
};

/// Times of one pass in every counted frame, milliseconds.
struct PassTimes {
    std::string name;
    std::vector<double> ms;
};

/// What the counted frames showed and took.
struct DrawnFrames {
    std::vector<Radiance> pictures;  ///< linear, after TAA and before the tone map
    std::vector<PassTimes> passes;   ///< without those that read pictures back
    std::vector<double> cpu_ms;      ///< process time
    uint64_t transient_bytes = 0;
    uint64_t persistent_bytes = 0;
};

/// Draws from a new world, so that nothing drawn before matters, waiting for each frame.
Result<DrawnFrames> draw_frames(gpu::Device& device, const StudioGroom& groom, const FrameRun& run);

/// By frame: the sum over all passes, and over those that an axis' techniques decide: projection,
/// visibility and TAA for opacity, everything else of hair for shadow, shading and what it reads
/// but shadow maps for the rest.
std::vector<double> frame_times(const DrawnFrames& frames);
std::vector<double> axis_times(const DrawnFrames& frames, std::string_view axis);
/// Whether a pass counts for an axis.
bool belongs(std::string_view pass, std::string_view axis);

}  // namespace vellus::demo
