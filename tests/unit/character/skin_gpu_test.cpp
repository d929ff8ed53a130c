#include <gtest/gtest.h>

#include <random>

#include "engine/gpu/upload_ring.h"
#include "modules/character/passes.h"
#include "modules/character/reference/skin.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::character {
namespace {

using SkinGpu = test::GpuTest;

constexpr uint32_t kJoints = 7;
constexpr uint32_t kTargets = 3;

class Random {
  public:
    float unit() { return std::uniform_real_distribution<float>(-1.0f, 1.0f)(engine_); }
    glm::vec3 vector() { return {unit(), unit(), unit()}; }
    uint32_t below(uint32_t limit) { return static_cast<uint32_t>(engine_() % limit); }
    glm::dmat4 affine() {
        glm::dmat4 m(1.0);
        for (int i = 0; i < 3; ++i) m[i] = glm::dvec4(m[i]) + 0.4 * glm::dvec4(vector(), 0.0);
        m[3] = glm::dvec4(3.0f * vector(), 1.0);
        return m;
    }

  private:
    std::mt19937 engine_{17};
};

asset::Primitive random_primitive(Random& random, uint32_t vertices, bool joints, bool targets) {
    asset::Primitive p;
    p.morph_targets.resize(targets ? kTargets : 0);
    for (uint32_t i = 0; i < vertices; ++i) {
        p.positions.push_back(random.vector());
        p.normals.push_back(glm::normalize(random.vector()));
        p.indices.push_back(i);
        if (joints) {
            p.joints.emplace_back(random.below(kJoints), random.below(kJoints),
                                  random.below(kJoints), random.below(kJoints));
            // Sums away from 1 on purpose; every eighth vertex has no weight at all.
            const glm::vec4 w(random.unit(), random.unit(), random.unit(), random.unit());
            p.weights.push_back(i % 8 == 7 ? glm::vec4(0.0f) : glm::abs(w) + 0.01f);
        }
        for (asset::MorphTarget& target : p.morph_targets) {
            target.positions.push_back(0.3f * random.vector());
            target.normals.push_back(0.3f * random.vector());
        }
    }
    return p;
}

/// The joint columns of one mesh at a camera 1e6 m out, where floats of world space would be lost.
DeformColumns random_columns(Random& random, const glm::dvec3& camera, uint32_t joints) {
    DeformColumns c;
    for (uint32_t j = 0; j < joints; ++j) {
        c.palette.push_back(random.affine());
        c.previous_palette.push_back(random.affine());
        if (j == 1) c.palette.back()[0] *= -1.0;  // mirrored
    }
    for (glm::dmat4& m : c.palette) m[3] += glm::dvec4(camera, 0.0);
    for (glm::dmat4& m : c.previous_palette) m[3] += glm::dvec4(camera, 0.0);
    c.joints.resize(joints);
    for (uint32_t t = 0; t < kTargets; ++t) {
        c.weights.push_back(random.unit());
        c.previous_weights.push_back(t == 1 ? 0.0f : random.unit());
    }
    return c;
}

/// The same in the camera's frame, for the reference.
std::vector<glm::dmat4> relative(std::vector<glm::dmat4> palette, const glm::dvec3& camera) {
    for (glm::dmat4& m : palette) m[3] -= glm::dvec4(camera, 0.0);
    return palette;
}

void check(gpu::Device& device, bool joints, bool targets) {
    SCOPED_TRACE(testing::Message() << "joints " << joints << " targets " << targets);
    Random random;
    const glm::dvec3 camera(1e6, -1e6, 1e6);
    const asset::Primitive primitive = random_primitive(random, 1003, joints, targets);
    const DeformColumns columns = random_columns(random, camera, joints ? kJoints : 1);

    auto scenes = scene::SceneLibrary{};
    auto scene_asset = std::make_shared<asset::SceneAsset>();
    scene_asset->meshes.push_back({"mesh", {primitive}, {}});
    scenes.assets.push_back(scene_asset);
    MeshLibrary library;
    const auto updated = library.update(device, scenes);
    ASSERT_TRUE(updated) << updated.error().message();
    auto ring = gpu::UploadRing::create(device, 1 << 16, 1);
    ASSERT_TRUE(ring);
    ring->begin_frame();

    World world;
    (void)world.spawn(scene::MeshInstance{0, 0},
                      MeshSlot{0, joints ? kJoints : 1, 0, targets ? kTargets : 0},
                      scene::WorldBounds{});
    scene::ViewState view;
    view.pose.position = camera;
    MeshDraws draws;
    collect_draws(world.query<const scene::MeshInstance, const MeshSlot, const scene::WorldBounds,
                              const SkyCover*>(),
                  scenes, library, columns, view, *ring, draws);
    ASSERT_EQ(draws.draws.size(), 1u);
    auto skinned =
        gpu::Buffer::create(device, draws.skinned_bytes, gpu::MemoryKind::kDevice, "out");
    ASSERT_TRUE(skinned);
    ASSERT_TRUE(device.submit_now("skin", [&](VkCommandBuffer handle) {
        gpu::CommandBuffer commands(handle);
        record_skinning(commands, draws.draws, library.pipelines, skinned->address());
    }));
    std::vector<SkinnedVertex> result(primitive.positions.size());
    ASSERT_TRUE(skinned->read_back(device, std::as_writable_bytes(std::span(result))));

    const auto now = reference::skin(primitive, relative(columns.palette, camera), columns.weights);
    const auto before = reference::skin(primitive, relative(columns.previous_palette, camera),
                                        columns.previous_weights);
    double worst = 0.0;
    double worst_normal = 0.0;
    for (size_t i = 0; i < result.size(); ++i) {
        worst = std::max({worst, glm::length(glm::dvec3(result[i].position) - now.positions[i]),
                          glm::length(glm::dvec3(result[i].previous) - before.positions[i])});
        worst_normal =
            std::max(worst_normal, glm::length(glm::dvec3(result[i].normal) - now.normals[i]));
    }
    // Metres near 5 in float: ulp 5e-7, some ten operations.
    EXPECT_LT(worst, 5e-6);
    // Blends of random matrices come close to singular, which magnifies rounding.
    EXPECT_LT(worst_normal, 1e-3);
}

TEST_F(SkinGpu, EqualsThePlainImplementation) {
    for (const bool joints : {false, true}) {
        for (const bool targets : {false, true}) check(device(), joints, targets);
    }
}

TEST_F(SkinGpu, UpdateUploadsEachAssetOnce) {
    Random random;
    scene::SceneLibrary scenes;
    auto asset = std::make_shared<asset::SceneAsset>();
    asset->meshes.push_back({"mesh", {random_primitive(random, 30, true, true)}, {}});
    asset->images.push_back({2, 1, {1, 2, 3, 4, 5, 6, 7, 8}});
    asset->images.push_back({2, 1, {1, 2, 3, 4, 5, 6, 7, 8}});
    asset->materials.resize(1);
    asset->materials[0].base_color_image = 1;
    scenes.assets.push_back(asset);
    MeshLibrary library;
    ASSERT_TRUE(library.update(device(), scenes));
    const uint64_t bytes = library.bytes();
    EXPECT_GE(bytes, 30 * sizeof(RestVertex) + 90 * sizeof(MorphDelta) + 30 * 4);
    EXPECT_FALSE(library.assets[0].images[0]) << "no material samples it";
    EXPECT_TRUE(library.assets[0].images[1]);
    const size_t pipelines = device().pipelines().created();
    ASSERT_TRUE(library.update(device(), scenes));
    EXPECT_EQ(library.bytes(), bytes);
    EXPECT_EQ(device().pipelines().created(), pipelines);
}

}  // namespace
}  // namespace vellus::character
