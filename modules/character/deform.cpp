#include "modules/character/deform.h"

#include <algorithm>
#include <map>

#include "engine/platform/jobs.h"
#include "modules/light/light_set.h"

namespace vellus::character {
namespace {

constexpr size_t kGrain = 256;

/// What a mesh's vertices span at rest: per joint, and per morph target.
struct MeshExtent {
    std::vector<scene::Box> joints;
    std::vector<scene::Box> targets;
};

void include_skinned(const asset::Primitive& primitive, MeshExtent& extent) {
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        for (int k = 0; k < 4; ++k) {
            const uint32_t joint = primitive.joints[v][k];
            if (primitive.weights[v][k] <= 0.0f || joint >= extent.joints.size()) continue;
            extent.joints[joint].include(glm::dvec3(primitive.positions[v]));
        }
    }
}

MeshExtent measure(const asset::Mesh& mesh, size_t joint_count, size_t target_count) {
    MeshExtent extent;
    extent.joints.resize(joint_count);
    extent.targets.resize(target_count);
    for (const asset::Primitive& primitive : mesh.primitives) {
        if (primitive.joints.empty() || primitive.weights.empty()) {
            for (const glm::vec3& p : primitive.positions) extent.joints[0].include(glm::dvec3(p));
        } else {
            include_skinned(primitive, extent);
        }
        for (size_t t = 0; t < primitive.morph_targets.size(); ++t) {
            extent.targets[t].include(glm::dvec3(0.0));
            for (const glm::vec3& d : primitive.morph_targets[t].positions) {
                extent.targets[t].include(glm::dvec3(d));
            }
        }
    }
    return extent;
}

size_t count_targets(const asset::Mesh& mesh) {
    size_t count = 0;
    for (const auto& primitive : mesh.primitives) {
        count = std::max(count, primitive.morph_targets.size());
    }
    return count;
}

/// Lays out the columns of one frame's meshes from the last one's.
class Layout {
  public:
    Layout(const scene::SceneLibrary& library, const DeformColumns& old)
        : library_(library), old_(old) {}

    MeshSlot add(Entity entity, const scene::MeshInstance& instance, const scene::NodeRef* ref,
                 const MeshSlot* before) {
        const asset::SceneAsset& scene = *library_.assets[instance.asset];
        const asset::Mesh& mesh = scene.meshes[instance.mesh];
        MeshSlot slot;
        slot.first_joint = static_cast<uint32_t>(columns.joints.size());
        slot.first_weight = static_cast<uint32_t>(columns.weights.size());
        slot.weight_count = static_cast<uint32_t>(count_targets(mesh));
        add_joints(entity, scene, instance.skin, ref);
        slot.joint_count = static_cast<uint32_t>(columns.joints.size()) - slot.first_joint;
        add_weights(scene, mesh, ref, slot.weight_count, before);
        const MeshExtent& extent = extent_of(instance, slot);
        columns.joint_boxes.insert(columns.joint_boxes.end(), extent.joints.begin(),
                                   extent.joints.end());
        columns.morph_boxes.insert(columns.morph_boxes.end(), extent.targets.begin(),
                                   extent.targets.end());
        ++columns.meshes;
        return slot;
    }

    DeformColumns columns;

  private:
    void add_joints(Entity entity, const asset::SceneAsset& scene, uint32_t skin_index,
                    const scene::NodeRef* ref) {
        if (skin_index == asset::kNone || ref == nullptr ||
            scene.skins[skin_index].joints.empty()) {
            columns.joints.push_back(entity);
            columns.inverse_bind.emplace_back(1.0);
            return;
        }
        const asset::Skin& skin = scene.skins[skin_index];
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            columns.joints.push_back(library_.entity(ref->instance, skin.joints[j]));
            columns.inverse_bind.push_back(
                skin.inverse_bind.empty() ? glm::dmat4(1.0) : glm::dmat4(skin.inverse_bind[j]));
        }
    }

    void add_weights(const asset::SceneAsset& scene, const asset::Mesh& mesh,
                     const scene::NodeRef* ref, uint32_t count, const MeshSlot* before) {
        const bool keeps = before != nullptr && before->weight_count == count;
        const std::vector<float>* given = &mesh.morph_weights;
        if (ref != nullptr && !scene.nodes[ref->node].morph_weights.empty()) {
            given = &scene.nodes[ref->node].morph_weights;
        }
        for (uint32_t i = 0; i < count; ++i) {
            const float rest = i < given->size() ? (*given)[i] : 0.0f;
            columns.weights.push_back(keeps ? old_.weights[before->first_weight + i] : rest);
            columns.settled.push_back(keeps ? old_.settled[before->first_weight + i] : 0);
        }
    }

    const MeshExtent& extent_of(const scene::MeshInstance& instance, const MeshSlot& slot) {
        const auto key = std::tuple(instance.asset, instance.mesh, slot.joint_count);
        const auto found = extents_.find(key);
        if (found != extents_.end()) return found->second;
        const asset::Mesh& mesh = library_.assets[instance.asset]->meshes[instance.mesh];
        return extents_.emplace(key, measure(mesh, slot.joint_count, slot.weight_count))
            .first->second;
    }

    const scene::SceneLibrary& library_;
    const DeformColumns& old_;
    std::map<std::tuple<uint32_t, uint32_t, uint32_t>, MeshExtent> extents_;
};

/// The box of all displacements the weights make: interval arithmetic over the targets.
scene::Box morph_box(const DeformColumns& columns, const MeshSlot& slot) {
    scene::Box sum{glm::dvec3(0.0), glm::dvec3(0.0)};
    for (uint32_t i = slot.first_weight; i < slot.first_weight + slot.weight_count; ++i) {
        const double weight = columns.weights[i];
        const glm::dvec3 low = weight * columns.morph_boxes[i].min;
        const glm::dvec3 high = weight * columns.morph_boxes[i].max;
        sum.min += glm::min(low, high);
        sum.max += glm::max(low, high);
    }
    return sum;
}

}  // namespace

void bind_meshes(
    Query<Entity, const scene::MeshInstance, const scene::NodeRef*, const MeshSlot*> all,
    Query<With<scene::MeshInstance>, Without<MeshSlot>> unbound,
    Res<const scene::SceneLibrary> library, Res<DeformColumns> columns, Commands& commands) {
    if (unbound.empty() && all.count() == columns->meshes) return;
    Layout layout(*library, *columns);
    all.each([&](Entity entity, const scene::MeshInstance& instance, const scene::NodeRef* ref,
                 const MeshSlot* before) {
        const MeshSlot slot = layout.add(entity, instance, ref, before);
        commands.add(entity, slot);
        if (before != nullptr) return;
        commands.add(entity, scene::WorldBounds{});
        // A character's own shadow on the ground is whole; a rigid mesh may be the ground.
        if (slot.joint_count > 1) commands.add(entity, light::ShadowFocus{});
    });
    layout.columns.previous_weights = layout.columns.weights;
    layout.columns.palette.assign(layout.columns.joints.size(), glm::dmat4(1.0));
    layout.columns.previous_palette = layout.columns.palette;
    layout.columns.rebuilds = columns->rebuilds + 1;
    *columns = std::move(layout.columns);
}

void update_palettes(Query<const scene::WorldTransform, const scene::PreviousWorldTransform> nodes,
                     Res<DeformColumns> columns) {
    DeformColumns& c = *columns;
    parallel_ranges(c.joints.size(), kGrain, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const auto node = nodes.get(c.joints[i]);
            if (!node) continue;  // a joint that is gone keeps its last pose
            c.palette[i] = std::get<0>(*node).matrix * c.inverse_bind[i];
            c.previous_palette[i] = std::get<1>(*node).matrix * c.inverse_bind[i];
        }
    });
    for (size_t i = 0; i < c.weights.size(); ++i) {
        if (c.settled[i] != 0) continue;
        c.previous_weights[i] = c.weights[i];
        c.settled[i] = 1;
    }
}

void update_bounds(Query<const MeshSlot, scene::WorldBounds> meshes,
                   Res<const DeformColumns> columns) {
    meshes.parallel_each(
        [&](const MeshSlot& slot, scene::WorldBounds& bounds) {
            const scene::Box morph = morph_box(*columns, slot);
            bounds.box = {};
            for (uint32_t j = slot.first_joint; j < slot.first_joint + slot.joint_count; ++j) {
                scene::Box box = columns->joint_boxes[j];
                if (box.empty()) continue;
                box.min += morph.min;
                box.max += morph.max;
                bounds.box.include(scene::transform(columns->palette[j], box));
            }
        },
        16);
}

}  // namespace vellus::character
