#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "modules/hair/groom/groom_file.h"
#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

using asset::Primitive;
using asset::SceneAsset;
using asset::Topology;

Primitive make_primitive(Topology topology, uint32_t points, std::vector<uint32_t> indices) {
    Primitive primitive;
    primitive.topology = topology;
    primitive.indices = std::move(indices);
    for (uint32_t i = 0; i < points; ++i) {
        primitive.positions.emplace_back(static_cast<float>(i), 0.0f, 0.0f);
    }
    return primitive;
}

SceneAsset make_scene(std::vector<Primitive> primitives) {
    SceneAsset scene;
    scene.meshes.push_back({.name = "hair", .primitives = std::move(primitives)});
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.roots = {0};
    return scene;
}

TEST(GltfGroom, EachStripIsAStrandAndTrianglesAreNot) {
    const auto groom =
        groom_from_scene(make_scene({make_primitive(Topology::kLineStrip, 3, {0, 1, 2}),
                                     make_primitive(Topology::kTriangles, 3, {0, 1, 2}),
                                     make_primitive(Topology::kLineStrip, 4, {3, 1})}),
                         "made");
    ASSERT_TRUE(groom) << groom.error().message();
    EXPECT_EQ(groom->strand_begin, (std::vector<uint32_t>{0, 3, 5}));
    EXPECT_EQ(groom->points[3].x, 3.0f);
    EXPECT_EQ(groom->points[4].x, 1.0f);
}

TEST(GltfGroom, JoinedLinesMakeOneStrandEach) {
    const auto groom = groom_from_scene(
        make_scene({make_primitive(Topology::kLines, 6, {0, 1, 1, 2, 4, 3, 5, 4})}), "made");
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->strand_begin, (std::vector<uint32_t>{0, 3, 5, 7}));
    EXPECT_EQ(groom->points[3].x, 4.0f);
}

TEST(GltfGroom, AttributesFollowThePointsAndGapsAreFilled) {
    Primitive with = make_primitive(Topology::kLineStrip, 2, {0, 1});
    with.thickness = {0.5f, 0.25f};
    with.colors = {{0.1f, 0.2f, 0.3f, 0.4f}, {0.5f, 0.6f, 0.7f, 0.8f}};
    with.texcoords = {{0.25f, 0.75f}, {0.25f, 0.75f}};
    const Primitive without = make_primitive(Topology::kLineStrip, 2, {0, 1});
    const auto groom = groom_from_scene(make_scene({without, with, without}), "made");
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->thickness, (std::vector<float>{0, 0, 0.5f, 0.25f, 0, 0}));
    EXPECT_EQ(groom->colors[1], glm::vec4(1.0f));
    EXPECT_EQ(groom->colors[3], glm::vec4(0.5f, 0.6f, 0.7f, 0.8f));
    // One coordinate along each strand: the root's.
    EXPECT_EQ(groom->strand_uvs, (std::vector<glm::vec2>{{0, 0}, {0.25f, 0.75f}, {0, 0}}));
    EXPECT_TRUE(groom->point_uvs.empty());
}

TEST(GltfGroom, NodesPlaceTheirMeshes) {
    SceneAsset scene = make_scene({make_primitive(Topology::kLineStrip, 2, {0, 1})});
    scene.meshes[0].primitives[0].thickness = {1.0f, 1.0f};
    scene.nodes[0].translation = {0.0f, 5.0f, 0.0f};
    scene.nodes[0].parent = 1;
    scene.nodes.push_back({.name = "top", .children = {0}, .scale = glm::vec3(2.0f)});
    const auto groom = groom_from_scene(scene, "made");
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->points[1], glm::vec3(2.0f, 10.0f, 0.0f));
    EXPECT_FLOAT_EQ(groom->thickness[1], 2.0f);
}

TEST(GltfGroom, SceneWithoutLinesIsAnErrorThatNamesIt) {
    const auto groom = groom_from_scene(
        make_scene({make_primitive(Topology::kTriangles, 3, {0, 1, 2})}), "cube.glb");
    ASSERT_FALSE(groom);
    EXPECT_NE(groom.error().message().find("cube.glb"), std::string::npos);
}

TEST(GltfGroom, WrittenFileIsLineStripsWithTrueBounds) {
    Groom groom = test::random_groom({3, 2, 7});
    groom.strand_uvs = {{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}};
    const auto bytes = write_glb(groom);
    ASSERT_TRUE(bytes) << bytes.error().message();
    uint32_t words[5];
    std::memcpy(words, bytes->data(), sizeof(words));
    EXPECT_EQ(words[0], 0x46546C67u);
    EXPECT_EQ(words[2], bytes->size());
    const std::string text(reinterpret_cast<const char*>(bytes->data()) + 20, words[3]);
    const auto json = nlohmann::json::parse(text);
    const auto& primitives = json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 3u);
    for (size_t strand = 0; strand < 3; ++strand) {
        EXPECT_EQ(primitives[strand]["mode"], 3);
        const auto& accessor =
            json["accessors"][primitives[strand]["attributes"]["POSITION"].get<size_t>()];
        EXPECT_EQ(accessor["count"], groom.point_count(strand));
        float lowest = 1e9f;
        for (uint32_t p = groom.strand_begin[strand]; p < groom.strand_begin[strand + 1]; ++p) {
            lowest = std::min(lowest, groom.points[p].y);
        }
        EXPECT_EQ(accessor["min"][1].get<float>(), lowest);
        const auto& view = json["bufferViews"][accessor["bufferView"].get<size_t>()];
        EXPECT_LE(accessor["byteOffset"].get<size_t>() + 12 * accessor["count"].get<size_t>(),
                  view["byteLength"].get<size_t>());
    }
}

TEST(GltfGroom, WhatGltfCannotHoldIsRefused) {
    EXPECT_FALSE(write_glb(Groom{}));
    EXPECT_NE(write_glb(test::random_groom({2, 1})).error().message().find("strand 1 has 1 points"),
              std::string::npos);
    Groom groom = test::random_groom({2});
    groom.points[1].y = std::nanf("");
    EXPECT_FALSE(write_glb(groom));
}

}  // namespace
}  // namespace vellus::hair
