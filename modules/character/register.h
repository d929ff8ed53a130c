#pragma once

#include "engine/ecs/schedule.h"
#include "engine/ecs/world.h"

namespace vellus::character {

/// DeformColumns and the systems bind_meshes, animate (stage simulate), update_palettes and
/// update_bounds (stage transforms). Needs register_scene.
void register_character(World& world, Schedule& schedule);

}  // namespace vellus::character
