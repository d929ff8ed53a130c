#pragma once

#include "game_demo/src/options.h"

namespace vellus::demo {

/// Opens a window and draws until it is closed, or for `options.frames` frames. The status says
/// how many validation messages there were.
Result<uint32_t> run_windowed(const Options& options);

}  // namespace vellus::demo
