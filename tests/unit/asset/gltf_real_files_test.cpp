#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/asset/gltf.h"
#include "engine/platform/files.h"
#include "tests/unit/asset/scene_invariants.h"
#include "tests/unit/asset/test_files.h"

namespace vellus::asset {
namespace {

namespace fs = std::filesystem;

/// The file's JSON, found without our reader: a GLB's first chunk starts at byte 20.
nlohmann::json json_of(const fs::path& path) {
    const auto bytes = read_file(path);
    std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (text.starts_with("glTF")) {
        uint32_t length = 0;
        std::memcpy(&length, text.data() + 12, 4);
        text = text.substr(20, length);
    }
    return nlohmann::json::parse(text);
}

/// Bounds that exporters computed when they wrote the file: every position and key time must agree
/// with them.
void expect_declared_bounds(const nlohmann::json& json, const SceneAsset& scene) {
    const auto& accessors = json["accessors"];
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        for (size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
            const auto& accessor =
                accessors[json["meshes"][m]["primitives"][p]["attributes"]["POSITION"]
                              .get<size_t>()];
            const auto& positions = scene.meshes[m].primitives[p].positions;
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                float low = positions.at(0)[axis];
                float high = low;
                for (const glm::vec3& v : positions) {
                    low = std::min(low, v[axis]);
                    high = std::max(high, v[axis]);
                }
                const auto a = static_cast<size_t>(axis);
                // JSON writes floats in decimal: to about seven digits.
                EXPECT_NEAR(low, accessor["min"][a].get<float>(), 1e-5f * std::abs(low) + 1e-7f);
                EXPECT_NEAR(high, accessor["max"][a].get<float>(), 1e-5f * std::abs(high) + 1e-7f);
            }
        }
    }
    for (size_t a = 0; a < scene.animations.size(); ++a) {
        const auto& animation = json["animations"][a];
        for (size_t c = 0; c < scene.animations[a].channels.size(); ++c) {
            const auto& sampler =
                animation["samplers"][animation["channels"][c]["sampler"].get<size_t>()];
            const auto& input = accessors[sampler["input"].get<size_t>()];
            const auto& times = scene.animations[a].channels[c].times;
            EXPECT_EQ(times.size(), input["count"].get<size_t>());
            EXPECT_NEAR(times.front(), input["min"][0].get<float>(), 1e-5f);
            EXPECT_NEAR(times.back(), input["max"][0].get<float>(), 1e-5f);
        }
    }
}

struct Counts {
    const char* file;
    size_t nodes;
    size_t primitives;
    size_t joints;
    std::vector<size_t> channels;
    size_t images;
    size_t morph_targets;
};

void PrintTo(const Counts& counts, std::ostream* out) {
    *out << counts.file;
}

class RealFile : public testing::TestWithParam<Counts> {};

TEST_P(RealFile, HasTheCountsAndBoundsOfItsJson) {
    const Counts& expected = GetParam();
    VELLUS_ASSET_FILE(path, std::string("gltf/") + expected.file)
    const auto scene = load_gltf(path);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(test::broken_promise(*scene), "");
    EXPECT_EQ(scene->path, path);
    EXPECT_EQ(scene->nodes.size(), expected.nodes);
    ASSERT_EQ(scene->meshes.size(), 1U);
    EXPECT_EQ(scene->meshes[0].primitives.size(), expected.primitives);
    EXPECT_EQ(scene->skins.empty() ? 0 : scene->skins[0].joints.size(), expected.joints);
    EXPECT_EQ(scene->images.size(), expected.images);
    for (const Image& image : scene->images) {
        EXPECT_FALSE(image.rgba.empty());
    }
    ASSERT_EQ(scene->animations.size(), expected.channels.size());
    for (size_t i = 0; i < expected.channels.size(); ++i) {
        EXPECT_EQ(scene->animations[i].channels.size(), expected.channels[i]);
    }
    for (const Primitive& primitive : scene->meshes[0].primitives) {
        EXPECT_EQ(primitive.morph_targets.size(), expected.morph_targets);
    }
    expect_declared_bounds(json_of(path), *scene);
}

INSTANTIATE_TEST_SUITE_P(Files, RealFile,
                         testing::Values(Counts{"Fox.glb", 26, 1, 24, {21, 21, 21}, 1, 0},
                                         Counts{
                                             "CesiumMan.collada2gltf.glb", 22, 1, 19, {57}, 1, 0},
                                         Counts{"SimpleSkin.gltf", 3, 1, 2, {1}, 0, 0},
                                         Counts{"MorphStressTest.gltf", 1, 2, 0, {1, 1, 1}, 3, 8},
                                         Counts{"sintel_bust.glb", 2, 1, 0, {}, 0, 0},
                                         Counts{"sintel_collider.glb", 2, 1, 0, {}, 0, 0}),
                         [](const auto& param_info) {
                             const std::string name = param_info.param.file;
                             return name.substr(0, name.find('.')).replace(0, 0, "");
                         });

TEST(RealFile, CesiumManStartsAfterTimeZero) {
    VELLUS_ASSET_FILE(path, "gltf/CesiumMan.collada2gltf.glb")
    const auto scene = load_gltf(path);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_NEAR(scene->animations[0].channels[0].times[0], 0.0417f, 1e-4f);
    EXPECT_FLOAT_EQ(scene->animations[0].duration, 2.0f);
}

TEST(RealFile, FoxAnimationsAreNamedAndItsNormalsAreFlat) {
    VELLUS_ASSET_FILE(path, "gltf/Fox.glb")
    const auto scene = load_gltf(path);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->animations[0].name, "Survey");
    EXPECT_EQ(scene->animations[1].name, "Walk");
    EXPECT_EQ(scene->animations[2].name, "Run");
    const Primitive& fox = scene->meshes[0].primitives[0];
    for (size_t i = 0; i + 2 < fox.indices.size(); i += 3) {
        const glm::vec3 edge = fox.positions[fox.indices[i + 1]] - fox.positions[fox.indices[i]];
        for (size_t k = 0; k < 3; ++k) {
            // Perpendicular to the edge within float rounding of coordinates up to 100.
            EXPECT_NEAR(glm::dot(fox.normals[fox.indices[i + k]], edge), 0.0f, 1e-3f);
        }
    }
}

}  // namespace
}  // namespace vellus::asset
