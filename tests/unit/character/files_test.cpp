// Real characters: the whole chain against an evaluation straight from the file's nodes.
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/asset/gltf.h"
#include "engine/ecs/schedule.h"
#include "modules/character/deform.h"
#include "modules/character/reference/skin.h"
#include "modules/character/register.h"
#include "modules/character/sampling.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"
#include "modules/scene/time.h"
#include "tests/unit/character/brute_force.h"

namespace vellus::character {
namespace {

std::filesystem::path data(const char* name) {
    return std::filesystem::path(VELLUS_TEST_DATA) / "gltf" / name;
}

/// All node transforms and weights at a time, recursively from the file, without the engine.
struct NodePose {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
    std::vector<float> weights;
};

std::vector<NodePose> pose_at(const asset::SceneAsset& scene, const asset::Animation* clip,
                              double time) {
    std::vector<NodePose> poses;
    for (const asset::Node& node : scene.nodes) {
        poses.push_back({node.translation, node.rotation, node.scale, node.morph_weights});
    }
    if (clip == nullptr) return poses;
    for (const asset::AnimationChannel& channel : clip->channels) {
        const auto v = test::brute_force(channel, time);
        NodePose& pose = poses[channel.node];
        if (channel.path == asset::AnimationPath::kTranslation)
            pose.translation = {v[0], v[1], v[2]};
        if (channel.path == asset::AnimationPath::kScale) pose.scale = {v[0], v[1], v[2]};
        if (channel.path == asset::AnimationPath::kRotation) {
            pose.rotation = glm::dquat(v[3], v[0], v[1], v[2]);
        }
        if (channel.path == asset::AnimationPath::kWeights) pose.weights.assign(v.begin(), v.end());
    }
    return poses;
}

glm::dmat4 global(const asset::SceneAsset& scene, const std::vector<NodePose>& poses,
                  uint32_t node) {
    const NodePose& pose = poses[node];
    const glm::dmat4 local = glm::translate(glm::dmat4(1.0), pose.translation) *
                             glm::mat4_cast(glm::normalize(pose.rotation)) *
                             glm::scale(glm::dmat4(1.0), pose.scale);
    const uint32_t parent = scene.nodes[node].parent;
    return parent == asset::kNone ? local : global(scene, poses, parent) * local;
}

/// glTF 2.0 section 3.7.3.3 word by word: joint matrices in the mesh node's frame, then that node.
std::vector<glm::dmat4> plain_palette(const asset::SceneAsset& scene,
                                      const std::vector<NodePose>& poses, uint32_t mesh_node) {
    const glm::dmat4 mesh_world = global(scene, poses, mesh_node);
    const uint32_t skin_index = scene.nodes[mesh_node].skin;
    if (skin_index == asset::kNone) return {mesh_world};
    const asset::Skin& skin = scene.skins[skin_index];
    std::vector<glm::dmat4> palette;
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        palette.push_back(mesh_world * glm::inverse(mesh_world) *
                          global(scene, poses, skin.joints[j]) * glm::dmat4(skin.inverse_bind[j]));
    }
    return palette;
}

class Characters : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(data(GetParam()))) {
            GTEST_SKIP() << data(GetParam()) << " is not here";
        }
        auto loaded = asset::load_gltf(data(GetParam()));
        ASSERT_TRUE(loaded) << loaded.error().message();
        asset = std::make_shared<asset::SceneAsset>(*std::move(loaded));
        ASSERT_FALSE(asset->animations.empty());
        scene::register_scene(world, schedule);
        register_character(world, schedule);
        ASSERT_TRUE(schedule.build(world));
        const auto made = scene::instantiate(world, asset);
        ASSERT_TRUE(made) << made.error().message();
        instance = *made;
    }
    void show(uint32_t animation, double time) {
        const Entity root = world.resource<scene::SceneLibrary>().instances[instance].root;
        AnimationPlayer player;
        player.animation = animation;
        player.time = time;
        player.loop = false;
        world.add(root, player);
        schedule.run(world);
    }

    std::shared_ptr<asset::SceneAsset> asset;
    World world;
    Schedule schedule{"test"};
    uint32_t instance = 0;
};

TEST_P(Characters, EveryTrackEqualsBruteForce) {
    size_t samples = 0;
    for (const asset::Animation& clip : asset->animations) {
        for (const asset::AnimationChannel& channel : clip.channels) {
            std::vector<float> out(channel.width);
            for (int i = -2; i < 60; ++i) {
                const double time = clip.duration * i / 55.0;
                sample(channel, time, out);
                const auto expected = test::brute_force(channel, time);
                for (uint32_t k = 0; k < channel.width; ++k) {
                    // Float rounding of values up to some hundred (Fox is in centimetres).
                    ASSERT_NEAR(out[k], expected[k], 1e-6 * std::max(1.0, std::abs(expected[k])));
                }
                ++samples;
            }
        }
    }
    EXPECT_GT(samples, 0u);
}

TEST_P(Characters, SkinningEqualsThePlainImplementation) {
    const scene::SceneLibrary& library = world.resource<scene::SceneLibrary>();
    const DeformColumns& columns = world.resource<DeformColumns>();
    size_t vertices = 0;
    for (uint32_t a = 0; a < asset->animations.size(); ++a) {
        for (int i = 0; i <= 7; ++i) {
            const asset::Animation& clip = asset->animations[a];
            const double time = clip.duration * i / 7.0;
            show(a, time);
            const auto poses = pose_at(*asset, &clip, time);
            for (uint32_t n = 0; n < asset->nodes.size(); ++n) {
                const Entity entity = library.entity(instance, n);
                const MeshSlot* slot = world.get<MeshSlot>(entity);
                if (slot == nullptr) continue;
                const std::span palette(columns.palette);
                const std::span weights(columns.weights);
                const auto expected_palette = plain_palette(*asset, poses, n);
                ASSERT_EQ(slot->joint_count, expected_palette.size());
                const scene::Box& box = world.get<scene::WorldBounds>(entity)->box;
                const double size = glm::length(box.max - box.min);
                for (const auto& primitive : asset->meshes[asset->nodes[n].mesh].primitives) {
                    const auto got = reference::skin(
                        primitive, palette.subspan(slot->first_joint, slot->joint_count),
                        weights.subspan(slot->first_weight, slot->weight_count));
                    const auto expected =
                        reference::skin(primitive, expected_palette, poses[n].weights);
                    for (size_t v = 0; v < got.positions.size(); ++v) {
                        // Rotations pass through float: 1e-7 of the size, per joint of the chain.
                        ASSERT_LT(glm::length(got.positions[v] - expected.positions[v]),
                                  3e-6 * size);
                        ASSERT_TRUE(
                            glm::all(glm::lessThanEqual(box.min, got.positions[v] + 1e-9 * size)));
                        ASSERT_TRUE(glm::all(
                            glm::greaterThanEqual(box.max, got.positions[v] - 1e-9 * size)));
                    }
                    vertices += got.positions.size();
                }
            }
        }
    }
    EXPECT_GT(vertices, 0u);
}

TEST_P(Characters, TheClipMovesTheMesh) {
    const DeformColumns& columns = world.resource<DeformColumns>();
    show(0, 0.0);
    const auto palette = columns.palette;
    const auto weights = columns.weights;
    show(0, 0.4 * asset->animations[0].duration);
    EXPECT_TRUE(palette != columns.palette || weights != columns.weights);
    EXPECT_EQ(columns.previous_palette, palette);
    EXPECT_EQ(columns.previous_weights, weights);
}

INSTANTIATE_TEST_SUITE_P(Files, Characters,
                         testing::Values("Fox.glb", "CesiumMan.collada2gltf.glb", "SimpleSkin.gltf",
                                         "MorphStressTest.gltf"),
                         [](const auto& file) {
                             const std::string name = file.param;
                             return name.substr(0, name.find('.'));
                         });

TEST(SimpleSkin, AtOneSecondTheUpperHalfLiesFlat) {
    if (!std::filesystem::exists(data("SimpleSkin.gltf"))) GTEST_SKIP() << "no shared data";
    auto loaded = asset::load_gltf(data("SimpleSkin.gltf"));
    ASSERT_TRUE(loaded) << loaded.error().message();
    const auto asset = std::make_shared<asset::SceneAsset>(*std::move(loaded));
    World world;
    Schedule schedule("test");
    scene::register_scene(world, schedule);
    register_character(world, schedule);
    ASSERT_TRUE(schedule.build(world));
    const auto made = scene::instantiate(world, asset);
    ASSERT_TRUE(made);
    AnimationPlayer player;
    player.time = 1.0;
    world.add(world.resource<scene::SceneLibrary>().instances[0].root, player);
    schedule.run(world);
    const asset::Primitive& primitive = asset->meshes[0].primitives[0];
    const auto skinned = reference::skin(primitive, world.resource<DeformColumns>().palette, {});
    // By hand: the second joint, at (0, 1, 0), has turned 90 degrees about Z; both bind matrices
    // move by (-0.5, -1, 0). The top edge hangs on it alone, the bottom one on the first joint. The
    // file gives no normals, so its triangles come without shared vertices.
    const std::vector<std::pair<glm::vec3, glm::dvec3>> moved = {
        {{1, 2, 0}, {-1, 1.5, 0}}, {{0, 2, 0}, {-1, 0.5, 0}}, {{0, 0, 0}, {-0.5, 0, 0}}};
    size_t found = 0;
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        for (const auto& [rest, expected] : moved) {
            if (primitive.positions[v] != rest) continue;
            EXPECT_LT(glm::length(skinned.positions[v] - expected), 1e-6);
            ++found;
        }
    }
    EXPECT_GE(found, 3u);
}

}  // namespace
}  // namespace vellus::character
