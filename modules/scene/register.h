#pragma once

#include "engine/ecs/schedule.h"
#include "engine/ecs/world.h"

namespace vellus::scene {

/// Resources SceneLibrary, FixedStep, ViewSettings, ViewState, Hierarchy (where the world has none)
/// and the systems propagate_transforms and update_view; orders the stages (stages.h).
/// Where the world has a RenderFrame, begin_frame too.
void register_scene(World& world, Schedule& schedule);

}  // namespace vellus::scene
