#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/asset/scene_asset.h"

namespace vellus::character {

/// Plays one of the asset's animations on a scene instance; lies on its InstanceRoot.
struct AnimationPlayer {
    uint32_t animation = 0;
    double time = 0.0;   ///< seconds played
    double phase = 0.0;  ///< seconds ahead of `time`, so that a crowd is out of step
    double speed = 1.0;
    bool loop = true;
    /// A second clip mixed in, always looping: with `mix` 0 it is `animation` alone; with 1 the
    /// other alone has the nodes it animates, `animation` the rest.
    uint32_t other = asset::kNone;
    double other_time = 0.0;
    double other_speed = 1.0;
    float mix = 0.0f;
};

/// Where a mesh's joints and morph weights lie in the DeformColumns; given by bind_meshes.
struct MeshSlot {
    uint32_t first_joint = 0;
    uint32_t joint_count = 0;  ///< 1 for meshes without skin: the node itself
    uint32_t first_weight = 0;
    uint32_t weight_count = 0;
};

/// What keeps the sky from a vertex; mirrored in shaders/character/mesh_data.glsl.
struct CoveredVertex {
    /// As packSnorm4x8: half of what is added to the normal where light arrives from (mesh space),
    /// and the share of the sky that nothing hides.
    uint32_t lean_and_open = 0;
    float depth = 0.0f;  ///< of what hides the rest of the sky
};
static_assert(sizeof(CoveredVertex) == 8);

/// What lies around a mesh and keeps the sky from it, worked out by whoever put it there (hair);
/// meshes without one see the whole sky.
struct SkyCover {
    /// On the device: a CoveredVertex for each vertex of all triangle primitives, in their order.
    uint64_t vertices = 0;
    uint64_t primitives = ~0ULL;  ///< bit i: primitive i has covered vertices; those from 63 on do
    float thickness = 1.0f;       ///< factor on all depths; 0: as without a cover
    /// Of the light that meets a unit of depth: shares that go on and that turn back.
    glm::vec3 forward{0.0f};
    glm::vec3 backward{0.0f};
};

}  // namespace vellus::character
