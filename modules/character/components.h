#pragma once

#include <cstdint>

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

}  // namespace vellus::character
