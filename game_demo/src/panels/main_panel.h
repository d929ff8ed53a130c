#pragma once

#include "game_demo/src/daylight.h"
#include "game_demo/src/demo_state.h"
#include "game_demo/src/renderer.h"

namespace vellus::demo {

/// The panel at the left edge: frame times, scene, clock, light, camera, hair.
void main_panel(DemoState& state, const FrameTimes& times, const Daylight* daylight,
                Renderer& renderer);

/// The keys, in the middle of the window.
void help_panel(DemoState& state);

}  // namespace vellus::demo
