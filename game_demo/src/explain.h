#pragma once

#include "game_demo/src/renderer.h"

namespace vellus::demo {

/// Prints the last frame's effect plan and frame graph to stdout.
void print_explanation(const Renderer& renderer);

}  // namespace vellus::demo
