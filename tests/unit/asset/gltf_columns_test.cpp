#include <gtest/gtest.h>

#include "engine/asset/gltf.h"
#include "tests/unit/asset/glb_builder.h"

// Custom vertex attributes and further colour sets.
namespace vellus::asset {
namespace {

using test::GlbBuilder;

/// A triangle with `attributes` beside its POSITION; accessor 0 is that, accessors follow the
/// views.
Result<SceneAsset> triangle(const GlbBuilder& builder, const std::string& accessors,
                            const std::string& attributes, bool normals = true) {
    return load_gltf_bytes(
        builder.glb(fmt::format(
            R"("accessors":[{}],"nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}],"scene":0,)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{},{}}}}}]}}])",
            accessors, normals ? R"(,"NORMAL":0)" : "", attributes)),
        {});
}

constexpr const char* kPositions =
    R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]})";

GlbBuilder with_positions() {
    GlbBuilder builder;
    builder.view(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1});
    return builder;
}

TEST(GltfColumns, KeepsCustomAttributesAndFurtherColours) {
    GlbBuilder builder = with_positions();
    builder.view(std::vector<float>{0.25f, 0.5f, 1.0f});
    builder.view(std::vector<uint8_t>{0, 255, 51, 0, 255, 0, 102, 0, 0, 0, 153, 0}, 4);
    const auto scene = triangle(
        builder,
        std::string(kPositions) +
            R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"})"
            R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":3,"type":"VEC3"})",
        R"("_SCALP":1,"COLOR_1":2)");
    ASSERT_TRUE(scene) << scene.error().message();
    const auto& columns = scene->meshes[0].primitives[0].columns;
    ASSERT_EQ(columns.size(), 2u);
    EXPECT_EQ(columns[0].name, "COLOR_1");
    EXPECT_EQ(columns[0].components, 3u);
    EXPECT_EQ(columns[0].values, (std::vector<float>{0, 1, 0.2f, 1, 0, 0.4f, 0, 0, 0.6f}));
    EXPECT_EQ(columns[1].name, "_SCALP");
    EXPECT_EQ(columns[1].components, 1u);
    EXPECT_EQ(columns[1].values, (std::vector<float>{0.25f, 0.5f, 1.0f}));
}

TEST(GltfColumns, FollowTheirVerticesWhenFacesAreSeparated) {
    GlbBuilder builder = with_positions();
    builder.view(std::vector<float>{1, 2, 3, 4, 5, 6});
    builder.view(std::vector<uint16_t>{2, 0, 1});
    const auto scene = load_gltf_bytes(
        builder.glb(std::string(R"("accessors":[)") + kPositions +
                    R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"})"
                    R"(,{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}],)"
                    R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0,)"
                    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"_PAIR":1},)"
                    R"("indices":2}]}])"),
        {});
    ASSERT_TRUE(scene) << scene.error().message();
    const Primitive& primitive = scene->meshes[0].primitives[0];
    EXPECT_EQ(primitive.positions[0], glm::vec3(0, 0, 1)) << "no normals: in the indices' order";
    EXPECT_EQ(primitive.columns[0].values, (std::vector<float>{5, 6, 1, 2, 3, 4}));
}

TEST(GltfColumns, WhatCannotBeReadIsLeftOutWithAWarning) {
    GlbBuilder builder = with_positions();
    builder.view(std::vector<float>{1, 2});
    const auto scene =
        triangle(builder,
                 std::string(kPositions) +
                     R"(,{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR"})",
                 R"("_SHORT":1)");
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_TRUE(scene->meshes[0].primitives[0].columns.empty());
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_NE(scene->warnings[0].find("_SHORT"), std::string::npos) << scene->warnings[0];
}

}  // namespace
}  // namespace vellus::asset
