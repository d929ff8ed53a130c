#include "modules/scene/instantiate.h"

#include <gtest/gtest.h>

#include "engine/ecs/schedule.h"
#include "modules/scene/register.h"
#include "modules/scene/transform.h"

namespace vellus::scene {
namespace {

using asset::SceneAsset;

/// root 0 -> 1 -> 3, and node 2 outside the scene.
std::shared_ptr<SceneAsset> small_scene() {
    auto scene = std::make_shared<SceneAsset>();
    scene->path = "folder/small.gltf";
    scene->nodes.resize(4);
    scene->nodes[0].name = "root";
    scene->nodes[0].children = {1};
    scene->nodes[1].children = {3};
    scene->nodes[1].translation = {1, 0, 0};
    scene->nodes[3].translation = {0, 1, 0};
    scene->nodes[3].camera = 0;
    scene->nodes[3].light = 0;
    scene->nodes[3].mesh = 0;
    scene->nodes[3].extensions = {{"VELLUS_hair", R"({"groom": "a.hair"})"}};
    scene->roots = {0};
    scene->cameras.resize(1);
    scene->cameras[0].vertical_fov = 0.5f;
    scene->lights.resize(1);
    scene->lights[0].intensity = 7.0f;
    scene->meshes.resize(1);
    return scene;
}

std::string error_of(const std::shared_ptr<SceneAsset>& scene) {
    World world;
    const auto result = instantiate(world, scene);
    EXPECT_EQ(world.entity_count(), 0u) << "nothing is made on failure";
    return result ? "no error" : result.error().message();
}

void expect_error(const std::shared_ptr<SceneAsset>& scene, const char* part) {
    const std::string message = error_of(scene);
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Instantiate, MakesAnEntityPerNodeBelowTheRoots) {
    World world;
    Schedule schedule("test");
    register_scene(world, schedule);
    const auto scene = small_scene();
    const auto first = instantiate(world, scene, {{0, 0, 5}});
    const auto second = instantiate(world, scene, {{0, 0, -5}});
    ASSERT_TRUE(first && second);
    ASSERT_TRUE(schedule.build(world));
    schedule.run(world);
    const SceneLibrary& library = world.resource<SceneLibrary>();
    EXPECT_EQ(library.assets.size(), 1u);
    EXPECT_EQ(library.entity(*first, 2), kNoEntity);
    EXPECT_EQ(library.entity(*first, 99), kNoEntity);
    EXPECT_EQ(world.entity_count(), 8u);
    const Entity leaf = library.entity(*second, 3);
    EXPECT_EQ(world.get<WorldTransform>(leaf)->matrix[3], glm::dvec4(1, 1, -5, 1));
    EXPECT_EQ(world.get<NodeRef>(leaf)->node, 3u);
    EXPECT_EQ(world.get<Name>(library.entity(*first, 0))->value, "root");
    EXPECT_EQ(world.get<Camera>(leaf)->vertical_fov, 0.5f);
    EXPECT_EQ(world.get<Light>(leaf)->intensity, 7.0f);
    EXPECT_EQ(world.get<MeshInstance>(leaf)->mesh, 0u);
    const auto* json = find_extension(world.get<NodeExtensions>(leaf)->list, "VELLUS_hair");
    ASSERT_NE(json, nullptr);
    EXPECT_EQ(*json, R"({"groom": "a.hair"})");
    EXPECT_EQ(find_extension(world.get<NodeExtensions>(leaf)->list, "other"), nullptr);
}

TEST(Instantiate, ErrorsNameFileAndField) {
    auto scene = small_scene();
    scene->nodes[3].mesh = 5;
    expect_error(scene, "folder/small.gltf: /nodes/3/mesh is 5, but there are 1");
    for (auto field : {&asset::Node::skin, &asset::Node::camera, &asset::Node::light}) {
        scene = small_scene();
        scene->nodes[1].*field = 3;
        expect_error(scene, "/nodes/1/");
    }
    scene = small_scene();
    scene->nodes[3].children = {1};
    expect_error(scene, "/nodes/3/children: node 1 has two parents or is its own ancestor");
    scene = small_scene();
    scene->roots = {4};
    expect_error(scene, "/scenes/nodes is 4, but there are 4");
}

TEST(Instantiate, SkinsAreChecked) {
    auto scene = small_scene();
    scene->skins.resize(1);
    scene->skins[0].joints = {0, 1};
    scene->skins[0].inverse_bind.resize(1);
    expect_error(scene, "/skins/0/inverseBindMatrices: 1 for 2 joints");
    scene->skins[0].joints = {0, 9};
    expect_error(scene, "/skins/0/joints is 9, but there are 4");
}

}  // namespace
}  // namespace vellus::scene
