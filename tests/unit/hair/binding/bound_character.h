#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/asset/gltf.h"
#include "engine/ecs/schedule.h"
#include "modules/character/deform.h"
#include "modules/character/reference/skin.h"
#include "modules/character/register.h"
#include "modules/hair/binding/bind_roots.h"
#include "modules/hair/binding/hair_pose.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"
#include "modules/scene/time.h"
#include "tests/support/fur.h"

namespace vellus::test {

/// Triangles of all primitives with joint indices as one list, and their corners' positions.
struct Skin {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
};

/// A file's character with fur all over its (first) mesh, animated on the CPU alone.
class BoundCharacter {
  public:
    /// Null, and the test is to be skipped, where the file is absent.
    static bool exists(const std::string& name) { return std::filesystem::exists(path(name)); }

    BoundCharacter(const std::string& name, size_t count, const scene::LocalTransform& place) {
        auto loaded = asset::load_gltf(path(name));
        EXPECT_TRUE(loaded) << loaded.error().message();
        asset = std::make_shared<asset::SceneAsset>(*std::move(loaded));
        scene::register_scene(world, schedule);
        character::register_character(world, schedule);
        EXPECT_TRUE(schedule.build(world));
        instance = *scene::instantiate(world, asset, place);
        for (mesh_node = 0; asset->nodes[mesh_node].mesh == asset::kNone; ++mesh_node) {
        }
        mesh = world.resource<scene::SceneLibrary>().entity(instance, mesh_node);
        schedule.run(world);
        grow(count);
    }

    [[nodiscard]] Entity root() const {
        return world.resource<scene::SceneLibrary>().instances[instance].root;
    }
    [[nodiscard]] const asset::Mesh& shape() const {
        return asset->meshes[asset->nodes[mesh_node].mesh];
    }
    [[nodiscard]] const character::MeshSlot& slot() const {
        return *world.get<character::MeshSlot>(mesh);
    }

    /// The plain implementation's surface under a palette and weights of the columns.
    [[nodiscard]] Skin skin(const std::vector<glm::dmat4>& palette,
                            const std::vector<float>& weights) const {
        Skin all;
        for (const asset::Primitive& primitive : shape().primitives) {
            const auto base = static_cast<uint32_t>(all.positions.size());
            const auto moved = character::reference::skin(
                primitive, std::span(palette).subspan(slot().first_joint, slot().joint_count),
                std::span(weights).subspan(slot().first_weight, slot().weight_count));
            all.positions.insert(all.positions.end(), moved.positions.begin(),
                                 moved.positions.end());
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                all.triangles.emplace_back(base + primitive.indices[i],
                                           base + primitive.indices[i + 1],
                                           base + primitive.indices[i + 2]);
            }
        }
        return all;
    }
    [[nodiscard]] Skin skin_now() const {
        const auto& columns = world.resource<character::DeformColumns>();
        return skin(columns.palette, columns.weights);
    }
    /// Where strand `s` (of `strands`) stands on that surface, by how it was grown.
    [[nodiscard]] glm::dvec3 root_on(const Skin& surface, size_t s) const {
        const uint32_t source = strands.strand_source[s];
        const glm::uvec3 corner = surface.triangles[fur.triangle[source]];
        const glm::dvec2 at = fur.barycentric[source];
        return surface.positions[corner.x] * (1.0 - at.x - at.y) +
               surface.positions[corner.y] * at.x + surface.positions[corner.z] * at.y;
    }

    void show(uint32_t animation, double time) {
        character::AnimationPlayer player;
        player.animation = animation;
        player.time = time;
        player.loop = false;
        world.add(root(), player);
        schedule.run(world);
        update_pose();
    }
    void update_pose() {
        const auto& now = *world.get<scene::WorldTransform>(root());
        const auto& before = *world.get<scene::PreviousWorldTransform>(root());
        hair::make_pose(bound, world.resource<character::DeformColumns>(), slot(), now.matrix,
                        before.matrix, pose);
    }
    [[nodiscard]] hair::RootFrame frame(size_t strand,
                                        hair::PoseOf when = hair::PoseOf::kNow) const {
        return hair::root_frame(bound, pose, static_cast<uint32_t>(strand), when);
    }
    /// A point of a strand in the world, as the binding carries it.
    [[nodiscard]] glm::dvec3 point(size_t strand, uint32_t index,
                                   hair::PoseOf when = hair::PoseOf::kNow) const {
        const hair::RootFrame at = frame(strand, when);
        return at.position + at.axes * glm::dvec3(bound.local[index]);
    }
    /// Middle edge of the box around the vertices a joint moves, of the whole mesh for none.
    [[nodiscard]] double size_of(const std::string& joint) const {
        const auto& columns = world.resource<character::DeformColumns>();
        scene::Box box;
        const uint32_t skin_index = asset->nodes[mesh_node].skin;
        for (uint32_t j = 0; j < slot().joint_count; ++j) {
            const bool named = skin_index != asset::kNone && !joint.empty();
            if (named && asset->nodes[asset->skins[skin_index].joints[j]].name != joint) continue;
            box.include(scene::transform(columns.palette[slot().first_joint + j],
                                         columns.joint_boxes[slot().first_joint + j]));
        }
        std::array edges = {box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z};
        std::ranges::sort(edges);
        return edges[1];  // the smallest one of a flat mesh is 0
    }

    std::shared_ptr<asset::SceneAsset> asset;
    World world;
    Schedule schedule{"test"};
    uint32_t instance = 0;
    uint32_t mesh_node = 0;
    Entity mesh;
    Fur fur;
    hair::StrandData strands;
    hair::BoundRoots bound;
    hair::HairPose pose;
    double fur_length = 0.0;

  private:
    static std::filesystem::path path(const std::string& name) {
        return std::filesystem::path(VELLUS_TEST_DATA) / "gltf" / name;
    }

    /// In the space of the instance's root, on the surface as the scene opens.
    void grow(size_t count) {
        Skin rest = skin_now();
        const glm::dmat4 to_root = glm::inverse(world.get<scene::WorldTransform>(root())->matrix);
        for (glm::dvec3& p : rest.positions) p = glm::dvec3(to_root * glm::dvec4(p, 1.0));
        scene::Box box;
        for (const glm::dvec3& p : rest.positions) box.include(p);
        fur_length = 0.03 * glm::length(box.max - box.min);
        fur = grow_fur(rest.positions, rest.triangles, count, fur_length, 5);
        strands = hair::prepare_strands(fur.groom, glm::dmat4(1.0), 1e-3f);
        auto mesh_at_rest = hair::rest_mesh(*asset, mesh_node);
        ASSERT_TRUE(mesh_at_rest) << mesh_at_rest.error().message();
        auto made = hair::bind_roots({strands.positions, strands.strand_begin}, glm::dmat4(1.0),
                                     *mesh_at_rest);
        ASSERT_TRUE(made) << made.error().message();
        bound = *std::move(made);
        update_pose();
    }
};

}  // namespace vellus::test
