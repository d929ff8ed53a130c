#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/platform/result.h"
#include "modules/hair/dynamics/components.h"

namespace vellus::hair {

constexpr std::string_view kColliderExtensionName = "VELLUS_collider";

/// VELLUS_collider on a glTF node: assets/schema/VELLUS_collider.schema.json.
struct ColliderExtension {
    HairCollider collider;
    std::vector<std::string> warnings;  ///< unknown fields, one line each
};

/// Parses the extension's JSON. `where` names file and node in messages; errors name the field.
Result<ColliderExtension> parse_collider_extension(std::string_view json, const std::string& where);

/// HairCollider on every node of the instance that has VELLUS_collider.
Result<void> spawn_scene_colliders(World& world, uint32_t instance);

}  // namespace vellus::hair
