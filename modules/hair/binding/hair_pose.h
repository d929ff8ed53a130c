#pragma once

#include <array>
#include <vector>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/character/deform.h"
#include "modules/hair/binding/bound_roots.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/components.h"
#include "modules/scene/bounds.h"
#include "modules/scene/components.h"

namespace vellus::hair {

/// What moves a bound groom this frame and moved it in the last, relative to `anchor` so that float
/// holds it anywhere: what the device gets.
struct HairPose {
    glm::dvec3 anchor{0.0};            ///< world, metres: where the groom's entity is
    std::vector<glm::mat4x3> palette;  ///< mesh to metres from the anchor: this frame's, the last's
    std::vector<float> weights;        ///< of morph targets: this frame's, the last's
    std::array<float, 2> scale{1.0f, 1.0f};  ///< metres per metre of the groom: now, before
    float handedness = 1.0f;                 ///< -1: the groom is mirrored against its rest
};

/// Poses of all bound grooms. Resource; HairBinding::pose says which is whose.
struct HairPoses {
    std::vector<HairPose> list;  ///< only the first `used` count; the rest keeps its memory
    uint32_t used = 0;
};

enum class PoseOf : uint8_t { kNow = 0, kBefore = 1 };

/// A strand's root in the world: point = position + axes * BoundRoots::local.
struct RootFrame {
    glm::dvec3 position{0.0};  ///< metres
    glm::dmat3 axes{1.0};      ///< tangent, normal, bitangent: orthogonal, as long as the scale
};

/// Where a strand's root is; the same as the device computes (root_frame.glsl), in float from the
/// anchor. Thread-safe.
RootFrame root_frame(const BoundRoots& bound, const HairPose& pose, uint32_t strand, PoseOf when);

/// Pose from the columns of the mesh's slot and the groom entity's transforms; reuses the memory.
void make_pose(const BoundRoots& bound, const character::DeformColumns& columns,
               const character::MeshSlot& slot, const glm::dmat4& world,
               const glm::dmat4& previous_world, HairPose& out);

/// Box around all points of the bound groom, in the world; widened by `margin` metres.
scene::Box pose_bounds(const BoundRoots& bound, const HairPose& pose, double margin);

/// System, stage view (palettes are ready): poses and bounds of all bound grooms.
void pose_hair(Query<const Hair, HairBinding, const scene::WorldTransform,
                     const scene::PreviousWorldTransform, scene::WorldBounds>
                   hair,
               Query<const character::MeshSlot> meshes, Res<const character::DeformColumns> columns,
               Res<const HairLibrary> library, Res<const HairBindings> bindings,
               Res<HairPoses> poses);

}  // namespace vellus::hair
