#include "modules/hair/binding/hair_pose.h"

#include <algorithm>
#include <cmath>

#include "engine/platform/jobs.h"
#include "modules/hair/binding/root_frame.h"
#include "modules/scene/view.h"

namespace vellus::hair {

namespace {

/// A bound vertex in one pose; the counterpart of skin_roots.comp.glsl.
struct Moved {
    glm::vec3 position;
    glm::vec3 normal;
};

Moved move_vertex(const BoundRoots& bound, const HairPose& pose, uint32_t index, PoseOf when) {
    const BoundVertex& v = bound.vertices[index];
    const bool before = when == PoseOf::kBefore;
    const glm::mat4x3* const palette = pose.palette.data() + (before ? pose.palette.size() / 2 : 0);
    const float* const weights = pose.weights.data() + (before ? pose.weights.size() / 2 : 0);
    glm::vec3 position = v.position;
    glm::vec3 normal = v.normal;
    for (uint32_t t = 0; t < bound.target_count; ++t) {
        if (weights[t] == 0.0f) continue;
        const BoundMorph& delta = bound.morphs[t * bound.vertices.size() + index];
        position += weights[t] * delta.position;
        normal += weights[t] * delta.normal;
    }
    const glm::mat4x3 m = palette[v.joints.x] * v.weights.x + palette[v.joints.y] * v.weights.y +
                          palette[v.joints.z] * v.weights.z + palette[v.joints.w] * v.weights.w;
    return {m * glm::vec4(position, 1.0f), glsl::map_normal(m, normal)};
}

/// Root and axes relative to the anchor; the counterpart of deform.comp.glsl.
struct FloatFrame {
    glm::vec3 position;
    glm::mat3 axes;
};

FloatFrame float_frame(const BoundRoots& bound, const HairPose& pose, uint32_t strand,
                       PoseOf when) {
    const BoundRoot& root = bound.roots[strand];
    const Moved a = move_vertex(bound, pose, root.vertices.x, when);
    const Moved b = move_vertex(bound, pose, root.vertices.y, when);
    const Moved c = move_vertex(bound, pose, root.vertices.z, when);
    const glm::vec2 at = root.barycentric;
    const glm::vec3 e1 = b.position - a.position;
    const glm::vec3 e2 = c.position - a.position;
    glm::vec3 normal = a.normal * (1.0f - at.x - at.y) + b.normal * at.x + c.normal * at.y;
    if (root.flat != 0) normal = glm::vec3(0.0f);
    const glm::mat3 axes = glsl::root_axes(e1, e2, normal, root.rest_inverse, pose.handedness);
    return {a.position + e1 * at.x + e2 * at.y, axes * pose.scale[static_cast<size_t>(when)]};
}

double signed_scale(const glm::dmat4& world) {
    return std::cbrt(glm::determinant(glm::dmat3(world)));
}

}  // namespace

RootFrame root_frame(const BoundRoots& bound, const HairPose& pose, uint32_t strand, PoseOf when) {
    const FloatFrame frame = float_frame(bound, pose, strand, when);
    return {pose.anchor + glm::dvec3(frame.position), glm::dmat3(frame.axes)};
}

void make_pose(const BoundRoots& bound, const character::DeformColumns& columns,
               const character::MeshSlot& slot, const glm::dmat4& world,
               const glm::dmat4& previous_world, HairPose& out) {
    out.anchor = world[3];
    out.palette.clear();
    out.weights.clear();
    for (const auto* palette : {&columns.palette, &columns.previous_palette}) {
        for (uint32_t j = 0; j < bound.joint_count; ++j) {
            out.palette.push_back(
                scene::relative_affine((*palette)[slot.first_joint + j], out.anchor));
        }
    }
    for (const auto* weights : {&columns.weights, &columns.previous_weights}) {
        const auto first = weights->begin() + slot.first_weight;
        out.weights.insert(out.weights.end(), first, first + bound.target_count);
    }
    const double now = signed_scale(world);
    out.scale = {static_cast<float>(std::abs(now)),
                 static_cast<float>(std::abs(signed_scale(previous_world)))};
    out.handedness = (now < 0.0) == (bound.rest_scale < 0.0) ? 1.0f : -1.0f;
}

scene::Box pose_bounds(const BoundRoots& bound, const HairPose& pose, double margin) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const BoundCluster& cluster : bound.clusters) {
        const FloatFrame frame = float_frame(bound, pose, cluster.strand, PoseOf::kNow);
        const glm::vec3 half = 0.5f * (cluster.high - cluster.low);
        const glm::vec3 center = frame.position + frame.axes * (cluster.low + half);
        const glm::vec3 extent = glm::abs(frame.axes[0]) * half.x +
                                 glm::abs(frame.axes[1]) * half.y +
                                 glm::abs(frame.axes[2]) * half.z;
        low = glm::min(low, center - extent);
        high = glm::max(high, center + extent);
    }
    if (bound.clusters.empty()) return {};
    return {pose.anchor + glm::dvec3(low) - margin, pose.anchor + glm::dvec3(high) + margin};
}

void pose_hair(Query<const Hair, HairBinding, const scene::WorldTransform,
                     const scene::PreviousWorldTransform, scene::WorldBounds>
                   hair,
               Query<const character::MeshSlot> meshes, Res<const character::DeformColumns> columns,
               Res<const HairLibrary> library, Res<const HairBindings> bindings,
               Res<HairPoses> poses) {
    poses->used = 0;
    if (poses->list.size() < hair.count()) poses->list.resize(hair.count());
    hair.each([&](const Hair& item, HairBinding& binding, const scene::WorldTransform& world,
                  const scene::PreviousWorldTransform& before, scene::WorldBounds& bounds) {
        const BoundRoots& bound = bindings->list[binding.roots].roots;
        const LibraryGroom& groom = library->grooms[item.groom];
        const auto slot = meshes.get(binding.mesh);
        // A slot of another shape: the mesh was exchanged for one the groom is not bound to.
        if (!slot || std::get<0>(*slot).joint_count < bound.joint_count ||
            std::get<0>(*slot).weight_count < bound.target_count) {
            binding.pose = kNoPose;
            bounds.box = scene::transform(world.matrix, groom_box(groom));
            return;
        }
        binding.pose = poses->used++;
        HairPose& pose = poses->list[binding.pose];
        make_pose(bound, *columns, std::get<0>(*slot), world.matrix,
                  before.known ? before.matrix : world.matrix, pose);
        bounds.box = pose_bounds(bound, pose, groom.width * pose.scale[0]);
    });
}

}  // namespace vellus::hair
