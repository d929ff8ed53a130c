#pragma once

#include "engine/ecs/ecs.h"

namespace vellus::demo {

/// Techniques, material, width and shadow of every groom, or of all at once; changes take effect in
/// the next frame.
void groom_panel(World& world);

}  // namespace vellus::demo
