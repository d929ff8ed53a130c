#pragma once

#include "engine/ecs/ecs.h"

namespace vellus::display {

/// The tone map that ends every frame; needs the scene module.
void register_display(World& world, Schedule& schedule);

}  // namespace vellus::display
