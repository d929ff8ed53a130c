#include "modules/character/deform.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/ecs/schedule.h"
#include "modules/character/reference/skin.h"
#include "modules/character/register.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"

namespace vellus::character {
namespace {

/// A row of 10 vertices at x = 0..9 on a chain of 3 joints, each vertex on two of them, with 2
/// morph targets that lift (+Y) and push (+Z).
std::shared_ptr<asset::SceneAsset> caterpillar() {
    auto scene = std::make_shared<asset::SceneAsset>();
    scene->path = "caterpillar.gltf";
    scene->nodes.resize(5);
    scene->nodes[0].children = {1, 4};
    scene->nodes[1].children = {2};
    scene->nodes[2].children = {3};
    scene->nodes[2].translation = {3, 0, 0};
    scene->nodes[3].translation = {3, 0, 0};
    scene->nodes[4].mesh = 0;
    scene->nodes[4].skin = 0;
    scene->nodes[4].translation = {100, 0, 0};  // a skinned mesh ignores its own node
    scene->roots = {0};
    scene->skins.resize(1);
    scene->skins[0].joints = {1, 2, 3};
    for (int j = 0; j < 3; ++j) {
        glm::mat4 inverse(1.0f);
        inverse[3].x = -3.0f * static_cast<float>(j);
        scene->skins[0].inverse_bind.push_back(inverse);
    }
    scene->meshes.resize(1);
    scene->meshes[0].morph_weights = {0.0f, 0.25f};
    asset::Primitive primitive;
    for (int i = 0; i < 10; ++i) {
        const auto low = static_cast<uint16_t>(std::min(i / 3, 2));
        primitive.positions.emplace_back(i, 0, 0);
        primitive.normals.emplace_back(0, 1, 0);
        primitive.joints.emplace_back(low, std::min<uint16_t>(low + 1, 2), 0, 0);
        primitive.weights.emplace_back(0.75f, 0.25f, 0.0f, 0.0f);
        primitive.indices.push_back(i);
    }
    primitive.morph_targets.resize(2);
    primitive.morph_targets[0].positions.assign(10, glm::vec3(0, 1, 0));
    primitive.morph_targets[1].positions.assign(10, glm::vec3(0, 0, 2));
    scene->meshes[0].primitives = {primitive};
    return scene;
}

class Deform : public testing::Test {
  protected:
    void SetUp() override {
        scene::register_scene(world, schedule);
        register_character(world, schedule);
        const auto built = schedule.build(world);
        ASSERT_TRUE(built) << built.error().message();
    }
    uint32_t place(const scene::LocalTransform& at = {}) {
        const auto index = scene::instantiate(world, asset, at);
        EXPECT_TRUE(index);
        return *index;
    }
    Entity node(uint32_t instance, uint32_t index) {
        return world.resource<scene::SceneLibrary>().entity(instance, index);
    }
    reference::SkinnedVertices skin(uint32_t instance) {
        const MeshSlot& slot = *world.get<MeshSlot>(node(instance, 4));
        const DeformColumns& c = world.resource<DeformColumns>();
        return reference::skin(asset->meshes[0].primitives[0],
                               std::span(c.palette).subspan(slot.first_joint, slot.joint_count),
                               std::span(c.weights).subspan(slot.first_weight, slot.weight_count));
    }

    std::shared_ptr<asset::SceneAsset> asset = caterpillar();
    World world;
    Schedule schedule{"test"};
};

TEST_F(Deform, RestPoseLeavesTheMeshInPlaceWhateverItsNode) {
    const uint32_t a = place({{0, 5, 0}});
    schedule.run(world);
    const auto vertices = skin(a);
    for (int i = 0; i < 10; ++i) {
        EXPECT_LT(glm::length(vertices.positions[i] - glm::dvec3(i, 5, 0.5)), 1e-12);  // + 0.25 x 2
        EXPECT_LT(glm::length(vertices.normals[i] - glm::dvec3(0, 1, 0)), 1e-12);
    }
}

TEST_F(Deform, ABentJointMovesItsVerticesOnly) {
    const uint32_t a = place();
    world.get<scene::LocalTransform>(node(a, 3))->rotation =
        glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1));
    schedule.run(world);
    const auto vertices = skin(a);
    EXPECT_LT(glm::length(vertices.positions[2] - glm::dvec3(2, 0, 0.5)), 1e-6);
    // The last joint turns at x = 6: its own vertices (weights on it alone) go up.
    EXPECT_LT(glm::length(vertices.positions[9] - glm::dvec3(6, 3, 0.5)), 1e-6);
    EXPECT_LT(glm::length(vertices.normals[9] - glm::dvec3(-1, 0, 0)), 1e-6);
}

TEST_F(Deform, PreviousPaletteAndWeightsAreLastFrames) {
    const uint32_t a = place();
    schedule.run(world);
    const DeformColumns& c = world.resource<DeformColumns>();
    EXPECT_EQ(c.previous_weights, c.weights) << "a new mesh has no velocity";
    EXPECT_EQ(c.previous_palette, c.palette);
    const auto before = c.palette;
    world.get<scene::LocalTransform>(node(a, 1))->translation = {0, 2, 0};
    world.resource<DeformColumns>().weights = {0.5f, 0.75f};
    schedule.run(world);
    EXPECT_EQ(c.previous_palette, before);
    EXPECT_NE(c.palette, before);
}

TEST_F(Deform, ColumnsFollowMeshesThatComeAndGo) {
    const uint32_t a = place();
    const uint32_t b = place({{0, 0, 7}});
    const Entity rigid = world.spawn(scene::LocalTransform{{1, 2, 3}}, scene::WorldTransform{},
                                     scene::PreviousWorldTransform{}, scene::MeshInstance{0, 0});
    schedule.run(world);
    DeformColumns& c = world.resource<DeformColumns>();
    EXPECT_EQ(c.joints.size(), 3u + 3u + 1u);
    EXPECT_EQ(c.weights.size(), 6u);
    const MeshSlot slot = *world.get<MeshSlot>(rigid);
    EXPECT_EQ(slot.joint_count, 1u);
    EXPECT_EQ(c.palette[slot.first_joint][3], glm::dvec4(1, 2, 3, 1));
    c.weights[world.get<MeshSlot>(node(b, 4))->first_weight] = 0.625f;
    const uint64_t rebuilds = c.rebuilds;
    schedule.run(world);
    EXPECT_EQ(c.rebuilds, rebuilds);
    world.destroy(node(a, 4));
    schedule.run(world);
    EXPECT_EQ(c.rebuilds, rebuilds + 1);
    EXPECT_EQ(c.joints.size(), 4u);
    EXPECT_EQ(c.weights[world.get<MeshSlot>(node(b, 4))->first_weight], 0.625f) << "kept";
    EXPECT_EQ(skin(b).positions[9], glm::dvec3(9, 0.625, 7.5));
}

TEST_F(Deform, BoundsHoldEveryVertexInRandomPoses) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const uint32_t a = place({{1e6, 0, 0}});
    schedule.run(world);
    for (int i = 0; i < 100; ++i) {
        for (const uint32_t joint : {1u, 2u, 3u}) {
            auto& local = *world.get<scene::LocalTransform>(node(a, joint));
            local.rotation =
                glm::normalize(glm::quat(unit(random), unit(random), unit(random), unit(random)));
            local.scale = glm::vec3(1.0f + 0.5f * unit(random));
        }
        for (float& weight : world.resource<DeformColumns>().weights) weight = 2.0f * unit(random);
        schedule.run(world);
        const scene::Box& box = world.get<scene::WorldBounds>(node(a, 4))->box;
        scene::Box exact;
        for (const auto& p : skin(a).positions) exact.include(p);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(box.min, exact.min + 1e-9)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.max, exact.max - 1e-9)));
        EXPECT_LT(glm::length(box.max - box.min), 60.0) << "not arbitrarily large";
    }
}

TEST(ReferenceSkin, WeightsAreNormalised) {
    asset::Primitive primitive;
    primitive.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    primitive.joints = {{0, 1, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
    primitive.weights = {{0.25f, 0.75f, 0, 0}, {1.0f, 3.0f, 0, 0}, {0, 0, 0, 0}};
    std::vector<glm::dmat4> palette(2, glm::dmat4(1.0));
    palette[1][3].x = 4.0;
    const auto result = reference::skin(primitive, palette, {});
    EXPECT_EQ(result.positions[0], glm::dvec3(4, 2, 3));
    EXPECT_EQ(result.positions[1], glm::dvec3(4, 2, 3));
    EXPECT_EQ(result.positions[2], glm::dvec3(5, 2, 3)) << "no weight at all: the first joint";
}

TEST(ReferenceSkin, NormalsStayPerpendicularUnderUnevenAndMirroredScale) {
    asset::Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}};
    const glm::vec3 normal = glm::normalize(glm::cross(glm::vec3(1, 0, 1), glm::vec3(0, 1, 0)));
    primitive.normals.assign(3, normal);
    for (const double mirror : {1.0, -1.0}) {
        glm::dmat4 matrix(1.0);
        matrix[0][0] = 5.0 * mirror;
        const auto result = reference::skin(primitive, {&matrix, 1}, {});
        const glm::dvec3 edge = result.positions[1] - result.positions[0];
        EXPECT_NEAR(glm::dot(result.normals[0], edge), 0.0, 1e-12);
        // It leaves the same side of the surface: mirroring x mirrors its x.
        EXPECT_GT(result.normals[0].z * normal.z, 0.0);
        EXPECT_GT(result.normals[0].x * normal.x * mirror, 0.0);
    }
}

}  // namespace
}  // namespace vellus::character
