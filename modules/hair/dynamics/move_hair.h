#pragma once

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/time.h"

namespace vellus::hair {

using MotionQuery =
    Query<Entity, const Hair, HairMotion, HairMoves, const scene::WorldTransform,
          const scene::PreviousWorldTransform, scene::WorldBounds, const HairBinding*>;
using ColliderQuery = Query<Entity, const HairCollider, const scene::WorldTransform>;

/// System, stage view, after poses and the view: decides what moves and why, and moves the guides
/// of all grooms that do (or says what the device is to solve). Widens bounds to where hair is.
void move_hair(MotionQuery hair, ColliderQuery colliders, Res<const HairBindings> bindings,
               Res<const HairPoses> poses, Res<const scene::ViewState> view,
               Res<const scene::FixedStep> step, Res<const Wind> wind, Res<HairMotions> motions);

}  // namespace vellus::hair
