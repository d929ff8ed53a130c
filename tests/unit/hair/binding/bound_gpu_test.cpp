// Bound hair in whole frames: the device against the CPU's frames, and against grooms that move
// with their node.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "modules/character/register.h"
#include "modules/hair/binding/bind_hair.h"
#include "modules/hair/binding/bind_roots.h"
#include "modules/hair/binding/deform_passes.h"
#include "modules/hair/geometry/hair_passes.h"
#include "modules/scene/instantiate.h"
#include "tests/support/hair_scene.h"
#include "tests/unit/hair/binding/bent_tube.h"

namespace vellus::hair {
namespace {

using test::BentTube;

constexpr uint32_t kSize = 160;

/// The tube on two joints, the upper one bent by the test, one metre before the camera.
class TubeScene : public test::HairScene {
  public:
    TubeScene(gpu::Device& gpu, const asset::Mesh& mesh) : HairScene(gpu, kSize, kSize) {
        character::register_character(world, schedule);
        add_sun(glm::normalize(glm::vec3(0.4f, 0.5f, 1)));
        auto asset = std::make_shared<asset::SceneAsset>();
        asset->path = "tube.gltf";
        asset->meshes = {mesh};
        asset->nodes = {
            {.name = "tube", .mesh = 0, .skin = 0}, {.name = "lower"}, {.name = "upper"}};
        asset->roots = {0, 1, 2};
        asset->skins = {{"skin", {1, 2}, {glm::mat4(1.0f), glm::mat4(1.0f)}}};
        instance = *scene::instantiate(world, asset, place());
        build();
    }
    static scene::LocalTransform place() {
        return {.translation = {0, 0, -1.2}, .rotation = glm::angleAxis(-1.4f, glm::vec3(1, 0, 0))};
    }
    [[nodiscard]] Entity node(uint32_t index) const {
        return world.resource<scene::SceneLibrary>().entity(instance, index);
    }
    [[nodiscard]] Entity root() const {
        return world.resource<scene::SceneLibrary>().instances[instance].root;
    }
    /// Fur on the tube, its entity below the instance's root.
    Entity wear(gpu::Device& gpu, const StrandData& strands, bool bound) {
        auto groom = add_strands(world, gpu, "fur", strands, {});
        EXPECT_TRUE(groom);
        HairExtension look;
        look.material.base_color = look.material.tip_color = glm::vec3(0.6f, 0.5f, 0.3f);
        const Entity hair = spawn_hair(world, *groom, look, {}, root());
        if (bound) {
            const auto done = bind_hair(world, gpu, hair, node(0));
            EXPECT_TRUE(done) << done.error().message();
        }
        return hair;
    }
    void bend(float angle) {
        world.get<scene::LocalTransform>(node(2))->rotation =
            glm::angleAxis(angle, glm::vec3(1, 0, 0));
    }
    void move(const glm::dvec3& by, float turn) {
        auto* transform = world.get<scene::LocalTransform>(root());
        transform->translation = place().translation + by;
        transform->rotation = glm::angleAxis(turn, glm::vec3(0, 1, 0)) * place().rotation;
    }
    [[nodiscard]] bool has_pass(std::string_view name) const {
        return std::ranges::any_of(executor->report().passes, [&](const graph::PassReport& pass) {
            return pass.name.starts_with(name);
        });
    }

    uint32_t instance = 0;
};

/// Points of this frame and the last, in the world, as the device has them.
std::array<std::vector<glm::dvec3>, 2> device_points(gpu::Device& gpu, const World& world) {
    const gpu::Buffer& buffer = world.resource<HairDeformation>().points;
    std::vector<glm::vec3> all(buffer.bytes() / sizeof(glm::vec3));
    EXPECT_TRUE(buffer.read_back(gpu, std::as_writable_bytes(std::span(all))));
    const HairFrame& frame = world.resource<HairFrame>();
    std::array<std::vector<glm::dvec3>, 2> points;
    if (frame.deforms.size() != 1) {
        ADD_FAILURE() << frame.deforms.size() << " deforms";
        return points;
    }
    const HairDeform& deform = frame.deforms[0];
    for (int i = 0; i < 2; ++i) {
        const VkDeviceAddress at = i == 0 ? deform.points : deform.previous_points;
        const size_t first = (at - buffer.address()) / sizeof(glm::vec3);
        for (size_t p = first; p < first + deform.strands->point_count; ++p) {
            points[i].push_back(deform.anchor + glm::dvec3(all[p]));
        }
    }
    return points;
}

class BoundHair : public test::GpuTest {};

TEST_F(BoundHair, TheDeviceCarriesPointsWhereTheCpuSays) {
    const BentTube tube(24, 30);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(777), true);
    std::vector<glm::dvec3> last;
    for (int frame = 0; frame < 5; ++frame) {
        scene.bend(0.2f * static_cast<float>(frame));
        scene.move({0.02 * frame, -0.01 * frame, 0.0}, 0.1f * static_cast<float>(frame));
        scene.draw();
        const auto points = device_points(device(), scene.world);
        const auto& binding = *scene.world.get<HairBinding>(hair);
        const BoundRoots& bound = scene.world.resource<HairBindings>().list[binding.roots].roots;
        const HairPose& pose = scene.world.resource<HairPoses>().list[binding.pose];
        for (uint32_t s = 0; s < bound.roots.size(); ++s) {
            for (const PoseOf when : {PoseOf::kNow, PoseOf::kBefore}) {
                const RootFrame at = root_frame(bound, pose, s, when);
                const auto& there = points[static_cast<size_t>(when)];
                for (uint32_t k = 0; k < bound.roots[s].point_count; ++k) {
                    const uint32_t p = bound.roots[s].first_point + k;
                    // Half a metre in float, some twenty operations.
                    ASSERT_LT(
                        glm::distance(there[p], at.position + at.axes * glm::dvec3(bound.local[p])),
                        1e-6);
                }
            }
        }
        // Velocities are finite differences: what was now is before.
        for (size_t p = 0; p < last.size(); ++p)
            ASSERT_LT(glm::distance(points[1][p], last[p]), 1e-6);
        last = points[0];
    }
}

/// Largest and mean difference of two pictures.
template <class T>
std::pair<double, double> difference(const std::vector<T>& a, const std::vector<T>& b) {
    double worst = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double d = glm::length(a[i] - b[i]);
        worst = std::max(worst, d);
        sum += d;
    }
    return {worst, sum / static_cast<double>(a.size())};
}

TEST_F(BoundHair, OnAMeshThatOnlyMovesItIsThePictureOfTheRigidGroom) {
    const BentTube tube(24, 30);
    std::vector<std::vector<glm::vec4>> pictures;
    std::vector<std::vector<glm::vec2>> velocities;
    for (const int way : {0, 1, 2}) {
        TubeScene scene(device(), tube.mesh());
        const Entity hair = scene.wear(device(), tube.fur(3000), way == 1);
        if (way == 2) scene.world.add(hair, HairMoves{true});
        scene.draw();
        // The joints below the root turn with it: as one piece.
        scene.move({0.1, 0.05, 0.1}, 0.3f);
        pictures.push_back(scene.draw());
        EXPECT_EQ(scene.has_pass("hair/deform"), way == 1);
        EXPECT_EQ(scene.has_pass("hair/carry"), way == 2);
        scene.move({0.13, 0.02, 0.2}, 0.4f);
        velocities.push_back(scene.draw_velocity());
    }
    for (const int way : {1, 2}) {
        // Positions agree to float rounding: a fragment at a pixel's or a dither's edge may flip.
        const auto [worst, mean] = difference(pictures[0], pictures[way]);
        EXPECT_LT(mean, 1e-3) << way;
        const auto [fastest, slip] = difference(velocities[0], velocities[way]);
        EXPECT_LT(slip, 1e-2) << way;
    }
    const auto lit = std::ranges::count_if(pictures[0], [](const glm::vec4& p) { return p.g > 0; });
    EXPECT_GT(lit, 1000);
    const auto moving = std::ranges::count_if(
        velocities[0], [](const glm::vec2& v) { return glm::length(v) > 1.0f; });
    EXPECT_GT(moving, 1000);
}

TEST_F(BoundHair, BendingMovesThePictureAndStandingStillHasNoVelocity) {
    const BentTube tube(24, 30);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(3000), true);
    scene.world.get<HairTechniques>(hair)->opacity = OpacityTechnique::kDitherStill;
    const auto straight = scene.draw();
    EXPECT_EQ(straight, scene.draw());
    const auto still = scene.draw_velocity();
    EXPECT_EQ(difference(still, std::vector<glm::vec2>(still.size())).first, 0.0);
    scene.bend(0.6f);
    const auto moving = scene.draw_velocity();
    EXPECT_GT(difference(moving, still).first, 10.0);
    const auto bent = scene.draw();
    // A tenth of the picture is fur, half of the fur moved.
    EXPECT_GT(difference(straight, bent).second, 0.005);
}

TEST_F(BoundHair, ATeleportHasNoVelocity) {
    const BentTube tube(24, 30);
    TubeScene scene(device(), tube.mesh());
    scene.wear(device(), tube.fur(500), true);
    scene.draw();
    scene.move({0.2, 0.1, 0.0}, 2.0f);
    scene.world.query<scene::PreviousWorldTransform>().each(
        [](scene::PreviousWorldTransform& previous) { previous.known = false; });
    const auto velocity = scene.draw_velocity();
    EXPECT_EQ(difference(velocity, std::vector<glm::vec2>(velocity.size())).first, 0.0);
}

TEST_F(BoundHair, WhatIsNotBoundCostsNothing) {
    const BentTube tube(12, 10);
    TubeScene scene(device(), tube.mesh());
    scene.wear(device(), tube.fur(200), false);
    scene.draw();
    const auto& deformation = scene.world.resource<HairDeformation>();
    const auto nothing = [&] {
        for (const char* pass : {"hair/skin_roots", "hair/deform", "hair/carry"}) {
            EXPECT_FALSE(scene.has_pass(pass)) << pass;
        }
        EXPECT_FALSE(deformation.points);
        EXPECT_EQ(deformation.skin, nullptr);
        EXPECT_EQ(deformation.carry, nullptr);
    };
    nothing();
    // A bound groom without strands is not drawn either.
    StrandData none;
    scene.wear(device(), none, true);
    scene.draw();
    nothing();
}

TEST_F(BoundHair, OutOfViewItIsNeitherDeformedNorDrawn) {
    const BentTube tube(12, 10);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(200), true);
    scene.world.get<HairTechniques>(hair)->shadow = ShadowTechnique::kNone;
    scene.draw();
    EXPECT_TRUE(scene.has_pass("hair/deform"));
    scene.move({50, 0, 0}, 0.0f);
    scene.draw();
    EXPECT_FALSE(scene.has_pass("hair/"));
    scene.move({0, 0, 0}, 0.0f);
    const auto back = scene.draw();
    EXPECT_TRUE(std::ranges::any_of(back, [](const glm::vec4& p) { return p.g > 0; }));
}

TEST_F(BoundHair, ItsShadowFollowsTheBend) {
    // Only the upper half wears fur; bent, its shadow map holds other texels.
    const BentTube tube(24, 30);
    TubeScene scene(device(), tube.mesh());
    scene.wear(device(), tube.fur(2000), true);
    const auto depths = [&] {
        scene.draw();
        const gpu::Buffer& map = scene.world.resource<HairShadowMaps>().depth;
        std::vector<uint32_t> words(map.bytes() / 4);
        EXPECT_TRUE(map.read_back(device(), std::as_writable_bytes(std::span(words))));
        return words;
    };
    const auto straight = depths();
    const auto again = depths();
    scene.bend(0.8f);
    const auto bent = depths();
    const auto filled = [](const auto& words) {
        return std::ranges::count_if(words, [](uint32_t word) { return word != 0; });
    };
    EXPECT_EQ(straight, again);
    EXPECT_GT(filled(straight), 1000);
    EXPECT_GT(filled(bent), filled(straight) / 2);
    EXPECT_NE(bent, straight);
}

TEST_F(BoundHair, WithoutItsMeshItMovesWithItsNode) {
    const BentTube tube(12, 10);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(400), true);
    scene.world.get<HairTechniques>(hair)->opacity = OpacityTechnique::kDitherStill;
    scene.draw();
    EXPECT_TRUE(scene.has_pass("hair/deform"));
    EXPECT_TRUE(unbind_hair(scene.world, hair));
    EXPECT_FALSE(unbind_hair(scene.world, hair));
    const auto loose = scene.draw();
    EXPECT_FALSE(scene.has_pass("hair/deform"));
    ASSERT_TRUE(bind_hair(scene.world, device(), hair, scene.node(0)));
    scene.draw();
    EXPECT_TRUE(scene.has_pass("hair/deform"));
    scene.world.destroy(scene.node(0));
    const auto orphan = scene.draw();
    EXPECT_FALSE(scene.has_pass("hair/deform"));
    const auto lit = [](const auto& pixels) {
        return std::ranges::count_if(pixels, [](const glm::vec4& p) { return p.g > 0; });
    };
    EXPECT_EQ(lit(orphan), lit(loose));
}

TEST_F(BoundHair, RebindsToAnotherMeshOfTheSameShape) {
    const BentTube tube(24, 30);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(600), true);
    EXPECT_FALSE(rebind_hair(scene.world, device(), scene.node(1), scene.node(0)))
        << "nothing is bound there";

    // The same shape elsewhere in the world, with other vertices, on another skeleton.
    auto other = std::make_shared<asset::SceneAsset>();
    other->path = "other.gltf";
    other->meshes = {tube.shuffled()};
    other->nodes = {{.name = "low"}, {.name = "high"}, {.name = "other", .mesh = 0, .skin = 0}};
    other->roots = {0, 1, 2};
    other->skins = {{"skin", {0, 1}, {glm::mat4(1.0f), glm::mat4(1.0f)}}};
    const scene::LocalTransform away{.translation = {0.3, 0.1, -1.5},
                                     .rotation = glm::angleAxis(0.6f, glm::vec3(0, 1, 0))};
    const uint32_t second = *scene::instantiate(scene.world, other, away);
    const auto& library = scene.world.resource<scene::SceneLibrary>();
    scene.bend(0.5f);
    scene.draw();
    const auto before = device_points(device(), scene.world)[0];
    const glm::dmat4 from = scene.world.get<scene::WorldTransform>(scene.root())->matrix;
    ASSERT_TRUE(rebind_hair(scene.world, device(), hair, library.entity(second, 2)));
    scene.world.get<scene::LocalTransform>(library.entity(second, 1))->rotation =
        glm::angleAxis(0.5f, glm::vec3(1, 0, 0));
    scene.draw();
    const auto after = device_points(device(), scene.world)[0];
    const glm::dmat4 to =
        scene.world.get<scene::WorldTransform>(library.instances[second].root)->matrix;
    ASSERT_EQ(before.size(), after.size());
    for (size_t p = 0; p < before.size(); ++p) {
        const glm::dvec3 expected(to * glm::inverse(from) * glm::dvec4(before[p], 1.0));
        ASSERT_LT(glm::distance(after[p], expected), 5e-6);
    }
}

TEST_F(BoundHair, BindingsAreSharedAndTheirPlacesUsedAgain) {
    const BentTube tube(12, 10);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(300), true);
    const auto& bindings = scene.world.resource<HairBindings>().list;
    const uint32_t groom = scene.world.get<Hair>(hair)->groom;
    const Entity twin = spawn_hair(scene.world, groom, {}, {}, scene.root());
    ASSERT_TRUE(bind_hair(scene.world, device(), twin, scene.node(0)));
    EXPECT_EQ(bindings.size(), 1u);
    scene.draw();
    const uint64_t bytes = device().memory().bytes_in_use();
    for (int again = 0; again < 5; ++again) {
        const glm::dmat4 aside = glm::translate(glm::dmat4(1.0), {0.01 * (again + 1), 0.0, 0.0});
        ASSERT_TRUE(rebind_hair(scene.world, device(), twin, scene.node(0), aside));
        scene.draw();
    }
    EXPECT_EQ(bindings.size(), 2u);
    scene.world.destroy(twin);
    ASSERT_TRUE(rebind_hair(scene.world, device(), hair, scene.node(0)));
    EXPECT_EQ(bindings.size(), 2u);
    scene.draw();
    EXPECT_LT(device().memory().bytes_in_use(), bytes + 100'000);
}

TEST_F(BoundHair, SteadyFramesMakeNothing) {
    const BentTube tube(12, 10);
    TubeScene scene(device(), tube.mesh());
    scene.wear(device(), tube.fur(300), true);
    for (int frame = 0; frame < 4; ++frame) scene.draw();
    const size_t pipelines = device().pipelines().created();
    const uint64_t objects = scene.executor->objects_created();
    const uint64_t bytes = device().memory().bytes_in_use();
    for (int frame = 0; frame < 8; ++frame) {
        scene.bend(0.1f * static_cast<float>(frame));
        scene.draw();
    }
    EXPECT_EQ(device().pipelines().created(), pipelines);
    EXPECT_EQ(scene.executor->objects_created(), objects);
    EXPECT_EQ(device().memory().bytes_in_use(), bytes);
}

TEST_F(BoundHair, ErrorsNameTheMesh) {
    const BentTube tube(12, 10);
    TubeScene scene(device(), tube.mesh());
    const Entity hair = scene.wear(device(), tube.fur(10), false);
    EXPECT_NE(
        bind_hair(scene.world, device(), hair, scene.node(1)).error().message().find("no mesh"),
        std::string::npos);
    EXPECT_NE(bind_hair(scene.world, device(), scene.node(1), scene.node(0))
                  .error()
                  .message()
                  .find("Hair"),
              std::string::npos);
    auto flat = std::make_shared<asset::SceneAsset>();
    flat->path = "flat.gltf";
    asset::Mesh mesh = tube.mesh();
    for (glm::vec3& p : mesh.primitives[0].positions) p = glm::vec3(0.0f);
    mesh.primitives[0].joints.clear();
    mesh.primitives[0].weights.clear();
    flat->meshes = {mesh};
    flat->nodes = {{.name = "dot", .mesh = 0}};
    flat->roots = {0};
    const uint32_t second = *scene::instantiate(scene.world, flat);
    const Entity dot = scene.world.resource<scene::SceneLibrary>().entity(second, 0);
    const std::string text = bind_hair(scene.world, device(), hair, dot).error().message();
    EXPECT_NE(text.find("flat.gltf: node 0 'dot'"), std::string::npos) << text;
    EXPECT_NE(text.find("no triangle has an area"), std::string::npos) << text;
    EXPECT_FALSE(scene.world.has<HairBinding>(hair));
}

}  // namespace
}  // namespace vellus::hair
