#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>

#include "engine/ecs/schedule.h"
#include "engine/frame_graph/context.h"
#include "engine/frame_graph/execute.h"
#include "modules/character/passes.h"
#include "modules/character/register.h"
#include "modules/light/register.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"
#include "modules/scene/stages.h"
#include "shaders/common/portable.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/one_mesh_scene.h"

namespace vellus::character {
namespace {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/pbr.glsl"
}  // namespace glsl

constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 72;
constexpr uint32_t kPixels = kWidth * kHeight;
constexpr double kDistance = 4.0;
constexpr float kFov = 0.6f;
/// Pixels: float rounding of a projection to about a hundred pixels.
constexpr float kStill = 1e-4f;

/// A square of side 2 facing +Z.
std::shared_ptr<asset::SceneAsset> square() {
    asset::Primitive p;
    p.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    p.normals.assign(4, {0, 0, 1});
    p.indices = {0, 1, 2, 0, 2, 3};
    return test::one_mesh_scene("square", std::move(p));
}

class MeshGpu : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        colors_ = readback(kPixels * 8);
        velocities_ = readback(kPixels * 4);
        ASSERT_TRUE(scene::insert_render_frame(world, device()));
        scene::register_scene(world, schedule);
        light::register_light(world, schedule);
        register_character(world, schedule);
        register_character_passes(world, schedule);
        world.resource<light::ShadowSettings>().size = 256;
        schedule
            .add("copy out",
                 [this](Res<scene::RenderFrame> frame) {
                     copy_out(frame->graph, frame->color, colors_, kPixels * 8);
                     copy_out(frame->graph, frame->velocity, velocities_, kPixels * 4);
                 })
            .in(scene::kDisplay);
        const auto built = schedule.build(world);
        ASSERT_TRUE(built) << built.error().message();
        auto executor = graph::Executor::create(device());
        ASSERT_TRUE(executor) << executor.error().message();
        executor_ = *std::move(executor);
        world.resource<scene::ViewSettings>().size = {kWidth, kHeight};
        (void)world.spawn(scene::LocalTransform{{0, 0, kDistance}}, scene::WorldTransform{},
                          scene::PreviousWorldTransform{}, scene::Camera{kFov, 0.1f},
                          scene::ActiveCamera{});
    }

    Entity place(const scene::LocalTransform& at) {
        const auto index = scene::instantiate(world, asset, at);
        EXPECT_TRUE(index);
        EXPECT_TRUE(
            world.resource<MeshLibrary>().update(device(), world.resource<scene::SceneLibrary>()));
        return world.resource<scene::SceneLibrary>().instances[*index].root;
    }
    void sun(float yaw) {
        const glm::quat turn = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
        (void)world.spawn(scene::LocalTransform{{}, turn}, scene::WorldTransform{},
                          scene::PreviousWorldTransform{},
                          scene::Light{asset::LightKind::kDirectional, glm::vec3(1), 3.0f});
    }
    void render() {
        ASSERT_TRUE(executor_->begin_frame());
        schedule.run(world);
        const auto& frame = world.resource<scene::RenderFrame>();
        ASSERT_FALSE(frame.error) << frame.error->message();
        const auto done = executor_->execute(frame.graph);
        ASSERT_TRUE(done) << done.error().message();
        ASSERT_TRUE(executor_->wait());
        ++world.resource<scene::FixedStep>().frame;
    }

    /// The pixel that shows a point of the plane z = 0.
    static glm::uvec2 pixel_of(double x, double y) {
        const double focal = 0.5 * kHeight / std::tan(0.5 * kFov);
        return {0.5 * kWidth + focal * x / kDistance, 0.5 * kHeight - focal * y / kDistance};
    }
    glm::vec3 color_at(double x, double y) {
        const glm::uvec2 p = pixel_of(x, y);
        const auto* texel =
            reinterpret_cast<const uint64_t*>(colors_.mapped()) + p.y * kWidth + p.x;
        return glm::vec3(glm::unpackHalf4x16(*texel));
    }
    glm::vec2 velocity_at(double x, double y) {
        const glm::uvec2 p = pixel_of(x, y);
        const auto* texel =
            reinterpret_cast<const uint32_t*>(velocities_.mapped()) + p.y * kWidth + p.x;
        return glm::unpackHalf2x16(*texel);
    }
    /// Radiance of the square at a point of z = 0 under the sun alone.
    glm::vec3 expected(double x, double y, float yaw) {
        const asset::Material& m = asset->materials[0];
        const glsl::PbrSurface surface{glm::vec3(m.base_color), m.metallic, m.roughness};
        const glm::vec3 to_light(std::sin(yaw), 0, std::cos(yaw));
        const glm::vec3 to_view = glm::normalize(glm::vec3(-x, -y, kDistance));
        return 3.0f * glsl::pbr_direct(surface, {0, 0, 1}, to_light, to_view);
    }

    std::shared_ptr<asset::SceneAsset> asset = square();
    World world;
    Schedule schedule{"test"};

  private:
    gpu::Buffer readback(uint64_t bytes) {
        auto buffer = gpu::Buffer::create(device(), bytes, gpu::MemoryKind::kReadback, "picture");
        EXPECT_TRUE(buffer);
        return buffer ? *std::move(buffer) : gpu::Buffer();
    }
    static void copy_out(graph::GraphDescription& graph, graph::ImageHandle image,
                         gpu::Buffer& target, uint64_t bytes) {
        auto pass = graph.add_pass("copy out", graph::PassKind::kTransfer);
        auto out = graph.import_buffer("picture", {bytes}, &target, graph::Access::kNone,
                                       graph::Access::kHostRead);
        pass.read(image, graph::Access::kTransferRead);
        out = pass.write(out, graph::Access::kTransferWrite, graph::Load::kDiscard);
        pass.execute([=](graph::PassContext& context) {
            const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                           .imageExtent = {kWidth, kHeight, 1}};
            vkCmdCopyImageToBuffer(context.commands().handle(), context.image(image),
                                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, context.buffer(out), 1,
                                   &region);
        });
        graph.output(out);
    }

    gpu::Buffer colors_;
    gpu::Buffer velocities_;
    std::unique_ptr<graph::Executor> executor_;
};

void expect_near(const glm::vec3& value, const glm::vec3& expected) {
    // Half floats hold 11 bits; the point lies anywhere in its pixel.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], 3e-3f * expected[i] + 1e-4f);
}

TEST_F(MeshGpu, ASquareUnderTheSunHasItsMaterialsRadiance) {
    sun(0.5f);
    (void)place({});
    render();
    for (const double x : {-0.8, 0.0, 0.8}) {
        expect_near(color_at(x, 0.5), expected(x, 0.5, 0.5f));
        EXPECT_LT(glm::length(velocity_at(x, 0.5)), kStill);
    }
    EXPECT_EQ(color_at(1.1, 0.0), glm::vec3(0)) << "beside the square";
}

TEST_F(MeshGpu, BackFacesAreCulledUnlessTwoSided) {
    sun(0.0f);
    const scene::LocalTransform turned{{}, glm::angleAxis(glm::pi<float>(), glm::vec3(0, 1, 0))};
    const Entity first = place(turned);
    render();
    EXPECT_EQ(color_at(0, 0), glm::vec3(0));
    world.destroy(first);
    asset = square();
    asset->materials[0].double_sided = true;
    (void)place(turned);
    render();
    expect_near(color_at(0.3, 0.3), expected(0.3, 0.3, 0.0f));
}

TEST_F(MeshGpu, AMirroredSquareIsStillLitFromItsFront) {
    sun(0.0f);
    (void)place({{}, glm::quat(1, 0, 0, 0), {-1, 1, 1}});
    render();
    expect_near(color_at(0.3, 0.3), expected(0.3, 0.3, 0.0f));
}

TEST_F(MeshGpu, VelocityIsTheMotionInPixels) {
    const Entity root = place({});
    render();
    EXPECT_LT(glm::length(velocity_at(0, 0)), kStill) << "first frame";
    world.get<scene::LocalTransform>(root)->translation = {0.2, 0.1, 0.0};
    world.resource<scene::ViewSettings>().jitter = {0.4f, -0.3f};
    render();
    const double focal = 0.5 * kHeight / std::tan(0.5 * kFov);
    const glm::vec2 moved(focal * 0.2 / kDistance, -focal * 0.1 / kDistance);
    // Half floats near 6 pixels: steps of 0.004.
    EXPECT_LT(glm::length(velocity_at(0.2, 0.1) - moved), 0.01f);
    render();
    EXPECT_LT(glm::length(velocity_at(0.2, 0.1)), kStill) << "at rest again";
}

TEST_F(MeshGpu, ASquareShadesTheOneBehindIt) {
    constexpr float kYaw = 0.785398f;
    sun(kYaw);
    (void)place({});
    // 1.5 m up the beam from (-0.5, 0, 0), a fifth of the size.
    const glm::dvec3 to_light(std::sin(kYaw), 0, std::cos(kYaw));
    (void)place({glm::dvec3(-0.5, 0, 0) + 1.5 * to_light, glm::quat(1, 0, 0, 0), glm::vec3(0.2f)});
    render();
    EXPECT_EQ(color_at(-0.5, 0.0), glm::vec3(0)) << "in the shadow";
    for (const auto& [x, y] : {std::pair(-0.5, 0.5), std::pair(-0.9, 0.0), std::pair(0.0, 0.0)}) {
        expect_near(color_at(x, y), expected(x, y, kYaw));
    }
}

TEST_F(MeshGpu, MovedAMillionMetresThePictureIsTheSame) {
    sun(0.5f);
    const Entity root = place({});
    render();
    const glm::vec3 here = color_at(0.4, 0.4);
    const glm::dvec3 offset(1e6, -1e6, 1e6);
    world.get<scene::LocalTransform>(root)->translation += offset;
    world.query<scene::LocalTransform, With<scene::Camera>>().each(
        [&](scene::LocalTransform& local) { local.translation += offset; });
    render();
    expect_near(color_at(0.4, 0.4), here);
    EXPECT_EQ(color_at(1.1, 0.0), glm::vec3(0));
}

}  // namespace
}  // namespace vellus::character
