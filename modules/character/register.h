#pragma once

#include "engine/ecs/schedule.h"
#include "engine/ecs/world.h"

namespace vellus::character {

/// DeformColumns and the systems bind_meshes, animate (stage simulate), update_palettes and
/// update_bounds (stage transforms). Needs register_scene.
void register_character(World& world, Schedule& schedule);

/// The drawing part: MeshLibrary, MeshDraws, MeshPasses and the systems of passes.h. Needs a
/// scene::RenderFrame and register_light; the host calls MeshLibrary::update after loading.
void register_character_passes(World& world, Schedule& schedule);

}  // namespace vellus::character
