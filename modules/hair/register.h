#pragma once

#include "engine/ecs/ecs.h"

namespace vellus::hair {

/// What needs no device: HairLibrary and bindings, bounds, poses and motion; part of register_hair.
void register_hair_columns(World& world, Schedule& schedule);

/// Resources (HairLibrary, HairFrame) and systems of the hair module; needs scene and light.
void register_hair(World& world, Schedule& schedule);

}  // namespace vellus::hair
