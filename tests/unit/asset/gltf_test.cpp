#include "engine/asset/gltf.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "engine/asset/image_io.h"
#include "tests/unit/asset/glb_builder.h"
#include "tests/unit/asset/scene_invariants.h"

namespace vellus::asset {
namespace {

using test::as_file;
using test::GlbBuilder;

/// Loads and expects success and every promise kept.
SceneAsset load(std::span<const std::byte> file) {
    auto scene = load_gltf_bytes(file, "");
    EXPECT_TRUE(scene) << scene.error().message();
    if (!scene) {
        return {};
    }
    EXPECT_EQ(test::broken_promise(*scene), "");
    return std::move(*scene);
}

/// Loads and expects an error whose line contains `text`.
void expect_refused(std::span<const std::byte> file, const std::string& text,
                    const GltfLimits& limits = {}) {
    const auto scene = load_gltf_bytes(file, "", limits);
    ASSERT_FALSE(scene) << "expected: " << text;
    EXPECT_NE(scene.error().message().find(text), std::string::npos) << scene.error().message();
    EXPECT_FALSE(scene.error().remedy.empty());
}

std::string document(const std::string& members) {
    return R"({"asset":{"version":"2.0"},)" + members + "}";
}

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

/// A mesh of `count` float positions in view 0 and what else `attributes` and `primitive` say.
std::string mesh_json(size_t count, const std::string& accessors, const std::string& attributes,
                      const std::string& primitive = "") {
    return fmt::format(
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}}{}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{}}}{}}}]}}])",
        count, accessors, attributes, primitive);
}

std::string accessor(size_t view, int component_type, size_t count, const std::string& type,
                     const std::string& more = "") {
    return fmt::format(R"(,{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})", view,
                       component_type, count, type, more);
}

TEST(Gltf, ScalesEveryNormalizedComponentType) {
    GlbBuilder b;
    b.view(kSquare);
    b.view<int8_t>({-128, 127, 0, 64, 1, -127, 0, 0});
    b.view<uint8_t>({0, 255, 51, 102, 1, 2, 3, 4});
    b.view<int16_t>({-32768, 32767, 0, 16384, 1, -1, 0, 0});
    b.view<uint16_t>({0, 65535, 13107, 26214, 1, 2, 3, 4});
    const std::vector<std::pair<int, std::vector<float>>> cases = {
        {5120, {-1, 1, 0, 64.0f / 127.0f, 1.0f / 127.0f, -1, 0, 0}},
        {5121, {0, 1, 0.2f, 0.4f, 1.0f / 255.0f, 2.0f / 255.0f, 3.0f / 255.0f, 4.0f / 255.0f}},
        {5122, {-1, 1, 0, 16384.0f / 32767.0f, 1.0f / 32767.0f, -1.0f / 32767.0f, 0, 0}},
        {5123,
         {0, 1, 0.2f, 0.4f, 1.0f / 65535.0f, 2.0f / 65535.0f, 3.0f / 65535.0f, 4.0f / 65535.0f}}};
    for (size_t i = 0; i < cases.size(); ++i) {
        const auto scene = load(
            b.glb(mesh_json(4, accessor(1 + i, cases[i].first, 4, "VEC2", R"(,"normalized":true)"),
                            R"(,"TEXCOORD_0":1)", R"(,"mode":0)")));
        const auto& uv = scene.meshes.at(0).primitives.at(0).texcoords;
        ASSERT_EQ(uv.size(), 4U);
        for (size_t k = 0; k < 8; ++k) {
            EXPECT_FLOAT_EQ(uv[k / 2][static_cast<glm::length_t>(k % 2)], cases[i].second[k])
                << cases[i].first;
        }
    }
}

TEST(Gltf, ReadsQuantizedPositionsUnscaled) {
    GlbBuilder b;
    b.view<int16_t>({0, -5, 7, 0, 300, 1, 2, 0, -32768, 32767, 9, 0}, 8);
    const auto scene = load(b.glb(
        R"("extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],
           "accessors":[{"bufferView":0,"componentType":5122,"count":3,"type":"VEC3"}],
           "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
    const auto& p = scene.meshes.at(0).primitives.at(0).positions;
    EXPECT_EQ(p.at(0), glm::vec3(0, -5, 7));
    EXPECT_EQ(p.at(2), glm::vec3(-32768, 32767, 9));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Gltf, ReadsInterleavedAttributes) {
    GlbBuilder b;
    b.view<float>({0, 0, 0, .1f, .2f, 1, 0, 0, .3f, .4f, 0, 1, 0, .5f, .6f}, 20);
    const auto scene = load(b.glb(
        mesh_json(3, accessor(0, 5126, 3, "VEC2", R"(,"byteOffset":12)"), R"(,"TEXCOORD_0":1)")));
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.positions.at(2), glm::vec3(0, 1, 0));
    EXPECT_EQ(p.texcoords.at(1), glm::vec2(.3f, .4f));
    EXPECT_EQ(p.normals.at(0), glm::vec3(0, 0, 1));
}

TEST(Gltf, PutsSparseValuesIntoStoredOnesAndIntoZeros) {
    GlbBuilder b;
    b.view(kSquare);
    b.view<uint16_t>({1, 3});
    b.view<float>({9, 8, 7, 6, 5, 4});
    const std::string sparse =
        R"("sparse":{"count":2,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}})";
    for (const bool stored : {true, false}) {
        const auto scene =
            load(b.glb(std::string(R"("accessors":[{)") + (stored ? R"("bufferView":0,)" : "") +
                       R"("componentType":5126,"count":4,"type":"VEC3",)" + sparse +
                       R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":0}]}])"));
        const auto& p = scene.meshes.at(0).primitives.at(0).positions;
        EXPECT_EQ(p.at(0), glm::vec3(0));
        EXPECT_EQ(p.at(1), glm::vec3(9, 8, 7));
        EXPECT_EQ(p.at(2), stored ? glm::vec3(0, 1, 0) : glm::vec3(0));
        EXPECT_EQ(p.at(3), glm::vec3(6, 5, 4));
    }
}

TEST(Gltf, TurnsEveryModeIntoOneOfFourTopologies) {
    GlbBuilder b;
    b.view(kSquare);
    b.view<uint8_t>({3, 2, 1, 0});
    const std::vector<std::pair<Topology, std::vector<uint32_t>>> expected = {
        {Topology::kPoints, {3, 2, 1, 0}},         {Topology::kLines, {3, 2, 1, 0}},
        {Topology::kLineStrip, {3, 2, 1, 0, 3}},   {Topology::kLineStrip, {3, 2, 1, 0}},
        {Topology::kTriangles, {3, 2, 1}},         {Topology::kTriangles, {3, 2, 1, 2, 0, 1}},
        {Topology::kTriangles, {2, 1, 3, 1, 0, 3}}};
    for (size_t mode = 0; mode < 7; ++mode) {
        const auto scene = load(b.glb(mesh_json(4, accessor(1, 5121, 4, "SCALAR"), "",
                                                fmt::format(R"(,"indices":1,"mode":{})", mode))));
        const Primitive& p = scene.meshes.at(0).primitives.at(0);
        EXPECT_EQ(p.topology, expected[mode].first);
        ASSERT_EQ(p.indices.size(), expected[mode].second.size()) << mode;
        for (size_t i = 0; i < p.indices.size(); ++i) {
            const uint32_t corner = expected[mode].second[i];
            EXPECT_EQ(
                p.positions[p.indices[i]],
                glm::vec3(kSquare[3 * corner], kSquare[3 * corner + 1], kSquare[3 * corner + 2]))
                << mode << " " << i;
        }
        EXPECT_EQ(scene.warnings.empty(), mode != 4) << mode;
    }
}

TEST(Gltf, TrianglesOfAStripFaceOneWay) {
    GlbBuilder b;
    b.view(kSquare);
    const auto scene = load(b.glb(mesh_json(4, "", "", R"(,"mode":5)")));
    for (const glm::vec3& normal : scene.meshes.at(0).primitives.at(0).normals) {
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
}

TEST(Gltf, KeepsTheFourStrongestInfluences) {
    GlbBuilder b;
    b.view<float>({0, 0, 0});
    b.view<uint8_t>({0, 1, 2, 3});
    b.view<uint16_t>({4, 5, 6, 7});
    b.view<float>({0.0f, 0.1f, 0.2f, 0.05f});
    b.view<float>({0.4f, 0.15f, 0.1f, 0.0f});
    const auto scene = load(b.glb(
        mesh_json(1,
                  accessor(1, 5121, 1, "VEC4") + accessor(3, 5126, 1, "VEC4") +
                      accessor(2, 5123, 1, "VEC4") + accessor(4, 5126, 1, "VEC4"),
                  R"(,"JOINTS_0":1,"WEIGHTS_0":2,"JOINTS_1":3,"WEIGHTS_1":4)", R"(,"mode":0)")));
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.joints.at(0), glm::u16vec4(4, 2, 5, 1));
    // 0.4, 0.2, 0.15 and the first 0.1, scaled to sum to 1.
    const glm::vec4 expected = glm::vec4(0.4f, 0.2f, 0.15f, 0.1f) / 0.85f;
    for (glm::length_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(p.weights.at(0)[i], expected[i], 1e-6f);
    }
    EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(Gltf, MatricesBecomeTheSameTransform) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-2.0f, 2.0f);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 t(number(random), number(random), number(random));
        const glm::vec3 s(number(random), number(random), i % 20 == 0 ? 0.0f : number(random));
        const glm::quat r = glm::normalize(
            glm::quat(number(random), number(random), number(random), number(random)));
        const glm::mat4 m =
            glm::translate(glm::mat4(1.0f), t) * glm::mat4_cast(r) * glm::scale(glm::mat4(1.0f), s);
        nlohmann::json matrix;
        for (glm::length_t k = 0; k < 16; ++k) {
            matrix.push_back(m[k / 4][k % 4]);
        }
        const auto scene = load(as_file(document(R"("nodes":[{"matrix":)" + matrix.dump() + "}]")));
        const Node& node = scene.nodes.at(0);
        const glm::mat4 again = glm::translate(glm::mat4(1.0f), node.translation) *
                                glm::mat4_cast(node.rotation) *
                                glm::scale(glm::mat4(1.0f), node.scale);
        for (glm::length_t k = 0; k < 16; ++k) {
            EXPECT_NEAR(again[k / 4][k % 4], m[k / 4][k % 4], 2e-5f) << i;
        }
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    }
}

TEST(Gltf, ReadsAllThreeInterpolationsAndPacksRotations) {
    GlbBuilder b;
    b.view<float>({0.5f, 2.0f});
    b.view<float>({1, 2, 3, 4, 5, 6});
    b.view<int16_t>({0, 0, 0, 32767, 32767, 0, 0, 0});
    b.view<float>(std::vector<float>(18, 0.25f));
    const auto scene = load(b.glb(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR","min":[0.5],"max":[2]})" +
        accessor(1, 5126, 2, "VEC3") + accessor(2, 5122, 2, "VEC4", R"(,"normalized":true)") +
        accessor(3, 5126, 6, "VEC3") +
        R"(],"nodes":[{}],"animations":[{"name":"move","samplers":[{"input":0,"output":1},
           {"input":0,"output":2,"interpolation":"STEP"},{"input":0,"output":3,"interpolation":"CUBICSPLINE"}],
           "channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},
           {"sampler":1,"target":{"node":0,"path":"rotation"}},{"sampler":2,"target":{"node":0,"path":"scale"}},
           {"sampler":2,"target":{"path":"pointer"}}]}])"));
    const Animation& a = scene.animations.at(0);
    ASSERT_EQ(a.channels.size(), 3U);
    EXPECT_EQ(a.duration, 2.0f);
    EXPECT_EQ(a.channels[0].interpolation, Interpolation::kLinear);
    EXPECT_EQ(a.channels[0].values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(a.channels[1].interpolation, Interpolation::kStep);
    EXPECT_EQ(a.channels[1].values, (std::vector<float>{0, 0, 0, 1, 1, 0, 0, 0}));
    EXPECT_EQ(a.channels[2].interpolation, Interpolation::kCubicSpline);
    EXPECT_EQ(a.channels[2].values.size(), 18U);
    EXPECT_EQ(scene.warnings.size(), 1U) << "the channel without a node";
}

TEST(Gltf, ReadsCamerasLightsAndTheirNodes) {
    const auto scene = load(as_file(document(
        R"("extensionsUsed":["KHR_lights_punctual"],
           "cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01,"zfar":100,"aspectRatio":1.5}},
                      {"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":9}}],
           "extensions":{"KHR_lights_punctual":{"lights":[
             {"type":"spot","intensity":40,"color":[1,0.5,0.25],"range":7,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.4}},
             {"type":"directional"},{"type":"point","name":"bulb"}]}},
           "nodes":[{"camera":1,"extensions":{"KHR_lights_punctual":{"light":2}}}])")));
    EXPECT_FLOAT_EQ(scene.cameras.at(0).vertical_fov, 0.7f);
    EXPECT_FLOAT_EQ(scene.cameras.at(0).aspect, 1.5f);
    EXPECT_EQ(scene.cameras.at(1).half_extent, glm::vec2(2, 3));
    EXPECT_FALSE(scene.cameras.at(1).perspective);
    EXPECT_EQ(scene.lights.at(0).kind, LightKind::kSpot);
    EXPECT_EQ(scene.lights.at(0).color, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_FLOAT_EQ(scene.lights.at(0).outer_cone, 0.4f);
    EXPECT_EQ(scene.lights.at(1).kind, LightKind::kDirectional);
    EXPECT_EQ(scene.lights.at(2).name, "bulb");
    EXPECT_EQ(scene.nodes.at(0).light, 2U);
    EXPECT_EQ(scene.nodes.at(0).camera, 1U);
    EXPECT_TRUE(scene.nodes.at(0).extensions.empty()) << "lights are understood, not handed on";
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Gltf, HandsOnExtensionsOfNodesAndOfTheDefaultScene) {
    const auto scene = load(as_file(document(
        R"("extensionsUsed":["A_node","A_scene"],"extensionsRequired":["A_node"],"scene":1,
           "scenes":[{"nodes":[0],"extensions":{"A_scene":{"first":1}}},{"nodes":[1],"extensions":{"A_scene":{"x":[1,2.5]}}}],
           "nodes":[{},{"extensions":{"A_node":{"file":"a.hair","deep":{"y":null}}}}])")));
    EXPECT_EQ(scene.roots, std::vector<uint32_t>{1});
    ASSERT_EQ(scene.extensions.size(), 1U);
    EXPECT_EQ(scene.extensions[0].name, "A_scene");
    EXPECT_EQ(nlohmann::json::parse(scene.extensions[0].json),
              nlohmann::json::parse(R"({"x":[1,2.5]})"));
    ASSERT_EQ(scene.nodes.at(1).extensions.size(), 1U);
    EXPECT_EQ(nlohmann::json::parse(scene.nodes[1].extensions[0].json),
              nlohmann::json::parse(R"({"file":"a.hair","deep":{"y":null}})"));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(Gltf, DecodesDataUris) {
    // One pixel as PNG, and three positions.
    const std::string png =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQYV2P4z/"
        "AfAAQAAf+I0P3MAAAAAElFTkSuQmCC";
    const auto scene = load_gltf_bytes(
        as_file(document(
            R"("images":[{"uri":"data:image/png;base64,)" + png +
            R"("}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
           "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
           "bufferViews":[{"buffer":0,"byteLength":36}],)" +
            mesh_json(3, "", "", R"(,"material":0)"))),
        "");
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->meshes.at(0).primitives.at(0).positions.at(1), glm::vec3(1, 0, 0));
    ASSERT_EQ(scene->images.size(), 1U);
    EXPECT_EQ(scene->images[0].rgba.size(), 4U);
    EXPECT_EQ(scene->materials.at(0).base_color_image, 0U);
}

TEST(Gltf, RefusesReferencesThatLeadAway) {
    for (const std::string uri : {"/etc/passwd", "file:///etc/passwd", "http://a/b", "C:\\\\b",
                                  "%00", "%zz", "", "a.bin"}) {
        expect_refused(as_file(document(R"("buffers":[{"byteLength":4,"uri":")" + uri + "\"}]")),
                       "/buffers/0/uri");
    }
}

TEST(Gltf, RefusesFilesThatAskForTooMuch) {
    expect_refused(
        as_file(document(R"("accessors":[{"componentType":5126,"count":4000000000,"type":"VEC3"}],
                                       "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])")),
        "/meshes/0/primitives/0/attributes/POSITION");
    // The same positions a hundred times: fine by default, too much with a multiple of 2.
    GlbBuilder b;
    b.view(std::vector<float>(300, 1.0f));
    std::string primitives;
    for (int i = 0; i < 100; ++i) {
        primitives +=
            fmt::format(R"({}{{"attributes":{{"POSITION":0}},"mode":0}})", i > 0 ? "," : "");
    }
    const auto file =
        b.glb(R"("accessors":[{"bufferView":0,"componentType":5126,"count":100,"type":"VEC3"}],
                               "meshes":[{"primitives":[)" +
              primitives + "]}]");
    EXPECT_EQ(load(file).meshes.at(0).primitives.size(), 100U);
    expect_refused(file, "2 times its files", GltfLimits{.fixed_bytes = 1000, .multiple = 2});
}

TEST(Gltf, LeavesOutImagesBeyondThePixelsAllowed) {
    GlbBuilder b;
    b.view(*encode_png(Image{8, 8, std::vector<uint8_t>(256, 200)}));
    const auto file = b.glb(
        R"("images":[{"bufferView":0,"mimeType":"image/png"},{"bufferView":0,"mimeType":"image/png"},
                               {"bufferView":0,"mimeType":"image/png"}])");
    EXPECT_EQ(load(file).images.at(2).rgba.size(), 256U);
    const auto scene = load_gltf_bytes(file, "", GltfLimits{.image_pixels = 150});
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->images.at(1).rgba.size(), 256U);
    EXPECT_TRUE(scene->images.at(2).rgba.empty());
    EXPECT_EQ(scene->warnings.size(), 1U);
}

TEST(Gltf, CountsObjectsAsMemory) {
    std::string nodes = "{}";
    for (int i = 0; i < 5000; ++i) {
        nodes += ",{}";
    }
    expect_refused(as_file(document(R"("nodes":[)" + nodes + "]")), "/nodes/",
                   GltfLimits{.fixed_bytes = 1U << 20U, .multiple = 64});
}

TEST(Gltf, RefusesNestingThatWouldOverflowAStack) {
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    expect_refused(as_file(document(R"("extras":)" + deep)), "nested deeper");
    std::string nodes;
    for (int i = 0; i < 599; ++i) {
        nodes += fmt::format(R"({{"children":[{}]}},)", i + 1);
    }
    nodes += "{}";
    expect_refused(as_file(document(R"("nodes":[)" + nodes + "]")), "nested deeper than 512");
    EXPECT_TRUE(
        load_gltf_bytes(as_file(document(R"("nodes":[)" + nodes + "]")), "", {.node_depth = 600}));
}

TEST(Gltf, RefusesWhatTinygltfWouldReadOutOfBounds) {
    GlbBuilder b;
    b.view(kSquare);
    b.view<uint16_t>({0, 9});
    const std::string mesh =
        R"(,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
    expect_refused(b.glb(R"("accessors":[{"bufferView":0,"componentType":5126,"count":5)" + mesh),
                   "/accessors/0");
    expect_refused(
        b.glb(
            R"("accessors":[{"bufferView":0,"byteOffset":9007199254740991,"componentType":5126,"count":4)" +
            mesh),
        "/accessors/0");
    expect_refused(b.glb(R"("accessors":[{"bufferView":7,"componentType":5126,"count":4)" + mesh),
                   "/accessors/0/bufferView");
    expect_refused(b.glb(R"("accessors":[{"bufferView":0,"componentType":5130,"count":4)" + mesh),
                   "componentType");
    expect_refused(b.glb(R"("images":[{"bufferView":3,"mimeType":"image/png"}])"),
                   "/images/0/bufferView");
    expect_refused(
        b.glb(
            R"("accessors":[{"componentType":5126,"count":4,"sparse":{"count":2,"indices":{"bufferView":1,
        "componentType":5123},"values":{"bufferView":0}})" +
            mesh),
        "/sparse/indices");
    expect_refused(b.glb(mesh_json(4, accessor(1, 5123, 2, "SCALAR"), "", R"(,"indices":1)")),
                   "index 1 is 9");
}

TEST(Gltf, RefusesSkinsThatDoNotFitTheirMeshes) {
    GlbBuilder b;
    b.view<float>({0, 0, 0});
    b.view<uint8_t>({2, 0, 0, 0});
    b.view<float>({1, 0, 0, 0});
    const std::string mesh =
        mesh_json(1, accessor(1, 5121, 1, "VEC4") + accessor(2, 5126, 1, "VEC4"),
                  R"(,"JOINTS_0":1,"WEIGHTS_0":2)", R"(,"mode":0)");
    const std::string nodes = R"(,"nodes":[{"mesh":0,"skin":0},{},{},{}],"skins":[{"joints":)";
    EXPECT_EQ(load(b.glb(mesh + nodes + "[1,2,3]}]")).skins.at(0).inverse_bind.size(), 3U);
    expect_refused(b.glb(mesh + nodes + "[1,2]}]"), "use joint 2, but skin 0 has 2");
}

TEST(Gltf, RefusesNegativeLights) {
    expect_refused(
        as_file(document(
            R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":-1}]}})")),
        "lights/0/intensity: -1 is out of range");
}

TEST(Gltf, RefusesEveryCutOffGlb) {
    GlbBuilder b;
    b.view(kSquare);
    const auto file = b.glb(mesh_json(4, "", ""));
    EXPECT_EQ(load(file).meshes.size(), 1U);
    for (size_t length = 0; length < file.size(); ++length) {
        EXPECT_FALSE(load_gltf_bytes(std::span(file).first(length), "")) << length;
    }
}

}  // namespace
}  // namespace vellus::asset
