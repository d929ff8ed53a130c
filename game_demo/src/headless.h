#pragma once

#include "engine/gpu/device.h"
#include "game_demo/src/options.h"

namespace vellus::demo {

/// Draws the frames asked for and writes DIR/frame_NNNN.png and DIR/stats.json.
Result<void> run_headless(gpu::Device& device, const Options& options);

}  // namespace vellus::demo
