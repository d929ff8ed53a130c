#include <gtest/gtest.h>

#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "game_demo/tools/reference/reference.h"
#include "modules/hair/binding/deform_passes.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/view.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::demo {
namespace {

using MovingHairTest = vellus::test::GpuTest;

constexpr uint32_t kFrame = 24;  // a third of a stride

Options walk() {
    Options options;
    options.scene = VELLUS_SOURCE_DIR "/assets/scenes/walk.gltf";
    options.size = {320, 240};
    return options;
}

/// Points of the moving strands in the demo's kFrame, metres from its camera.
std::vector<glm::dvec3> drawn_points(gpu::Device& device) {
    auto renderer = Renderer::create(device, {});
    EXPECT_TRUE(renderer && load_content(**renderer, walk()));
    for (uint32_t frame = 0; frame <= kFrame; ++frame) {
        EXPECT_TRUE((*renderer)->draw(Output::kNowhere));
    }
    EXPECT_TRUE((*renderer)->wait());
    World& world = (*renderer)->world();
    const hair::HairDeform& deform = world.resource<hair::HairFrame>().deforms.at(0);
    std::vector<glm::vec3> points(deform.strands->point_count);
    EXPECT_TRUE(world.resource<hair::HairDeformation>().points.read_back(
        device, std::as_writable_bytes(std::span(points))));
    const glm::dvec3 camera = world.resource<scene::ViewState>().pose.position;
    std::vector<glm::dvec3> placed;
    placed.reserve(points.size());
    for (const glm::vec3& point : points) {
        placed.push_back(deform.anchor - camera + glm::dvec3(point));
    }
    return placed;
}

double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::vec4>& b) {
    double most = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, glm::distance(a[i], glm::dvec3(b[i])));
    }
    return most;
}

TEST_F(MovingHairTest, IsTracedWhereTheDemoDrawsIt) {
    ReferenceOptions options;
    options.content = walk();
    options.frame = kFrame;
    const auto traced = load_reference(options);
    ASSERT_TRUE(traced) << traced.error().message();
    const auto drawn = drawn_points(device());
    const auto groom = std::ranges::find_if(traced->scene.grooms, [&](const auto& candidate) {
        return candidate.points.size() == drawn.size();
    });
    ASSERT_NE(groom, traced->scene.grooms.end());
    // The solver is the same; the device keeps turns in 16 bits, 3e-5 of half a metre of hair, and
    // points in float.
    EXPECT_LT(farthest(drawn, groom->points), 5e-5);

    options.frame = kFrame - 1;
    const auto before = load_reference(options);
    ASSERT_TRUE(before);
    const size_t which = groom - traced->scene.grooms.begin();
    EXPECT_GT(farthest(drawn, before->scene.grooms[which].points), 1e-3);
}

}  // namespace
}  // namespace vellus::demo
