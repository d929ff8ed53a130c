#include "modules/hair/grow/region.h"

#include <gtest/gtest.h>

#include "engine/asset/gltf.h"
#include "engine/asset/image_io.h"
#include "modules/hair/grow/roots.h"
#include "tests/support/own_folder.h"

namespace vellus::hair {
namespace {

/// A unit square in the plane z = 0, moved by its node to x = 10; _SCALP is 1 at x = 1, COLOR_1.g
/// at y = 1.
asset::SceneAsset square() {
    asset::Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    primitive.columns.push_back({"_SCALP", 1, {0, 1, 1, 0}});
    primitive.columns.push_back({"COLOR_1", 3, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    asset::SceneAsset scene;
    scene.path = "square.gltf";
    scene.meshes.push_back({"plane", {primitive}, {}});
    asset::Node node;
    node.name = "board";
    node.translation = {10, 0, 0};
    node.mesh = 0;
    scene.nodes.push_back(node);
    scene.roots = {0};
    return scene;
}

glm::dvec3 mean_root(const GrowSurface& surface) {
    const auto roots = grow::scatter_roots(surface, 4'000, 1);
    glm::dvec3 mean(0.0);
    for (const auto& root : roots) mean += root.position / static_cast<double>(roots.size());
    return mean;
}

TEST(GrowRegion, WithoutAChoiceAllIsHairedWhereItsNodePutsIt) {
    const auto surface = surface_from_scene(square(), {});
    ASSERT_TRUE(surface) << surface.error().message();
    EXPECT_NEAR(haired_area(*surface), 1.0, 1e-6);
    EXPECT_LT(glm::distance(mean_root(*surface), glm::dvec3(10.5, 0.5, 0.0)), 0.02);
    const glm::dvec4 corner = surface->to_mesh * glm::dvec4(surface->positions[2], 1.0);
    EXPECT_LT(glm::distance(glm::dvec3(corner), glm::dvec3(1, 1, 0)), 1e-9);
}

TEST(GrowRegion, AVertexGroupGivesTheDensity) {
    // Density x on the unit square: area 1/2, mean place x = 2/3.
    const auto scalp = surface_from_scene(square(), {.group = "_SCALP"});
    ASSERT_TRUE(scalp) << scalp.error().message();
    EXPECT_NEAR(haired_area(*scalp), 0.5, 1e-6);
    EXPECT_LT(glm::distance(mean_root(*scalp), glm::dvec3(10.0 + 2.0 / 3.0, 0.5, 0.0)), 0.02);
    const auto color = surface_from_scene(square(), {.group = "COLOR_1.g"});
    ASSERT_TRUE(color) << color.error().message();
    EXPECT_LT(glm::distance(mean_root(*color), glm::dvec3(10.5, 2.0 / 3.0, 0.0)), 0.02);
}

TEST(GrowRegion, ASphereCutsThroughTriangles) {
    const auto surface =
        surface_from_scene(square(), {.sphere = glm::vec4(10.5f, 0.5f, 0.0f, 0.4f)});
    ASSERT_TRUE(surface) << surface.error().message();
    for (const auto& root : grow::scatter_roots(*surface, 2'000, 1)) {
        EXPECT_LT(glm::distance(root.position, glm::dvec3(10.5, 0.5, 0.0)), 0.4001);
    }
}

TEST(GrowRegion, AMaskIsReadOverTheTextureCoordinates) {
    test::OwnFolder folder("mask");
    // White in the upper left quarter: u < 1/2, v < 1/2, so x < 1/2 and y > 1/2.
    asset::Image image{2, 2, std::vector<uint8_t>(16, 0)};
    std::fill_n(image.rgba.begin(), 4, uint8_t{255});
    const auto path = folder.path() / "mask.png";
    ASSERT_TRUE(asset::save_png(path, image));
    const auto surface = surface_from_scene(square(), {.mask = path});
    ASSERT_TRUE(surface) << surface.error().message();
    const glm::dvec3 mean = mean_root(*surface);
    EXPECT_LT(mean.x, 10.5);
    EXPECT_GT(mean.y, 0.5);
    asset::SceneAsset unmapped = square();
    unmapped.meshes[0].primitives[0].texcoords.clear();
    EXPECT_FALSE(surface_from_scene(unmapped, {.mask = path}));
}

TEST(GrowRegion, AJointsWeightIsAGroup) {
    asset::SceneAsset scene = square();
    asset::Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.joints.assign(4, {0, 1, 0, 0});
    primitive.weights = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
    scene.nodes.resize(3);
    scene.nodes[1].name = "neck";
    scene.nodes[2].name = "head";
    scene.nodes[2].translation = {0, 5, 0};
    scene.skins.push_back({"skin", {1, 2}, {glm::mat4(1.0f), glm::mat4(1.0f)}});
    scene.nodes[0].skin = 0;
    const auto surface = surface_from_scene(scene, {.group = "head"});
    ASSERT_TRUE(surface) << surface.error().message();
    // The head joint carries its two corners 5 up; a skinned mesh ignores its own node.
    EXPECT_EQ(surface->positions[1], glm::vec3(1, 5, 0));
    EXPECT_EQ(surface->positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(surface->density, (std::vector<float>{0, 1, 1, 0}));
}

TEST(GrowRegion, ErrorsSayWhatThereIs) {
    const auto group = surface_from_scene(square(), {.group = "_BEARD"});
    ASSERT_FALSE(group);
    EXPECT_NE(group.error().message().find("_SCALP"), std::string::npos) << group.error().message();
    const auto mesh = surface_from_scene(square(), {.mesh = "head"});
    ASSERT_FALSE(mesh);
    EXPECT_NE(mesh.error().message().find("board"), std::string::npos) << mesh.error().message();
    EXPECT_FALSE(surface_from_scene(asset::SceneAsset{}, {}));
}

}  // namespace
}  // namespace vellus::hair
