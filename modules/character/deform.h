#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/commands.h"
#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/character/components.h"
#include "modules/scene/bounds.h"
#include "modules/scene/library.h"

namespace vellus::character {

/// What deforms all meshes of the world, in flat columns: joints (one palette entry each) and morph
/// weights. Resource. A mesh without skin has one joint, its node, bound by the identity.
struct DeformColumns {
    std::vector<Entity> joints;
    std::vector<glm::dmat4> inverse_bind;
    std::vector<scene::Box>
        joint_boxes;                  ///< vertices the joint moves, before skinning; may be empty
    std::vector<glm::dmat4> palette;  ///< mesh space to world: joint world x inverse bind
    std::vector<glm::dmat4> previous_palette;

    std::vector<float> weights;
    std::vector<float> previous_weights;
    std::vector<scene::Box> morph_boxes;  ///< displacements of the target at weight 1
    std::vector<uint8_t> settled;         ///< 0: new this frame, has no previous weight yet

    uint32_t meshes = 0;
    uint64_t rebuilds = 0;
};

/// System: gives every MeshInstance a MeshSlot and WorldBounds; lays the columns out anew when a
/// mesh came or went, and does nothing otherwise. Weights of meshes that stay are kept.
void bind_meshes(
    Query<Entity, const scene::MeshInstance, const scene::NodeRef*, const MeshSlot*> all,
    Query<With<scene::MeshInstance>, Without<MeshSlot>> unbound,
    Res<const scene::SceneLibrary> library, Res<DeformColumns> columns, Commands& commands);

/// System: palettes of this frame and the last from the joints' world transforms.
void update_palettes(Query<const scene::WorldTransform, const scene::PreviousWorldTransform> nodes,
                     Res<DeformColumns> columns);

/// System: box around each deformed mesh. Every vertex is a convex combination of its joints'
/// images, so the union of the joints' transformed boxes holds it.
void update_bounds(Query<const MeshSlot, scene::WorldBounds> meshes,
                   Res<const DeformColumns> columns);

}  // namespace vellus::character
