#pragma once

#include <memory>

#include "engine/ecs/world.h"
#include "engine/platform/result.h"
#include "modules/scene/camera.h"
#include "modules/scene/library.h"

namespace vellus::scene {

/// Registers the asset (once) in the world's SceneLibrary; its index there.
uint32_t add_asset(World& world, const std::shared_ptr<const asset::SceneAsset>& asset);

/// Makes an entity per node below the asset's roots, and one above them (InstanceRoot) at `place`.
/// The instance's index in the SceneLibrary, or an Error that names file and field: an index out of
/// range, a node with two parents, a cycle, an inverse bind matrix too few. Nothing is made then.
Result<uint32_t> instantiate(World& world, const std::shared_ptr<const asset::SceneAsset>& asset,
                             const LocalTransform& place = {});

/// A camera entity with this pose, the active one; remove ActiveCamera from any other.
Entity spawn_camera(World& world, const CameraPose& pose);

}  // namespace vellus::scene
