#pragma once

#include "engine/ecs/ecs.h"

namespace vellus::hair {

/// Resources (HairLibrary, HairFrame) and systems of the hair module; needs scene and light.
void register_hair(World& world, Schedule& schedule);

}  // namespace vellus::hair
