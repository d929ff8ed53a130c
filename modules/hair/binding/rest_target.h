#pragma once

#include <string>

#include "engine/ecs/ecs.h"
#include "modules/hair/binding/rest_mesh.h"

namespace vellus::hair {

/// The mesh of an entity, and the entity or instance whose space it rests in.
struct RestTarget {
    const asset::SceneAsset* asset = nullptr;
    uint32_t asset_index = 0;
    uint32_t mesh = 0;  ///< as in BindingKey
    uint32_t instance = asset::kNone;
    Entity space;

    /// For messages.
    [[nodiscard]] std::string name() const;
    /// Palette and mesh as rest_palette() and rest_mesh() have them.
    [[nodiscard]] std::vector<glm::dmat4> palette() const;
    [[nodiscard]] Result<RestMesh> at_rest() const;
};

/// Errors: the entity has no MeshInstance.
Result<RestTarget> find_rest_target(const World& world, Entity entity);

/// Where an entity is in the target's rest space: up its parents, from the first node of that
/// instance on by the file's transforms. Without such a node: relative to the target's space as
/// things are now.
glm::dmat4 placement_at_rest(const World& world, const RestTarget& target, Entity entity);

}  // namespace vellus::hair
