#pragma once

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/character/components.h"
#include "modules/character/deform.h"
#include "modules/scene/library.h"
#include "modules/scene/time.h"

namespace vellus::character {

/// System: samples every player's clip into the LocalTransforms of its instance's nodes and the
/// weights of its meshes, then moves the player on by dt x speed. Frame 0 shows time 0 + phase.
void animate(Query<const scene::InstanceRoot, AnimationPlayer> players,
             Query<scene::LocalTransform> nodes, Query<const MeshSlot> meshes,
             Res<const scene::SceneLibrary> library, Res<const scene::FixedStep> step,
             Res<DeformColumns> columns);

}  // namespace vellus::character
