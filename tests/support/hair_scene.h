#pragma once

#include <glm/gtc/packing.hpp>
#include <vector>

#include "engine/frame_graph/execute.h"
#include "modules/display/readback.h"
#include "modules/display/register.h"
#include "modules/hair/components.h"
#include "modules/hair/register.h"
#include "modules/hair/spawn.h"
#include "modules/light/environment.h"
#include "modules/light/register.h"
#include "modules/scene/camera.h"
#include "modules/scene/register.h"
#include "modules/scene/render_frame.h"
#include "modules/temporal/register.h"
#include "modules/temporal/temporal.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::test {

/// Strands as columns: each inner vector is one strand, root to tip.
inline hair::StrandData make_strands(const std::vector<std::vector<glm::vec3>>& strands,
                                     float width) {
    hair::Groom groom;
    for (const auto& strand : strands) {
        groom.points.insert(groom.points.end(), strand.begin(), strand.end());
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return hair::prepare_strands(groom, glm::dmat4(1.0), width);
}

/// A world with all render modules, a camera at the origin looking along -Z, TAA off, no light.
class HairScene {
  public:
    HairScene(gpu::Device& device, uint32_t width, uint32_t height) : device_(device) {
        EXPECT_TRUE(scene::insert_render_frame(world, device));
        scene::register_scene(world, schedule);
        light::register_light(world, schedule);
        hair::register_hair(world, schedule);
        temporal::register_temporal(world, schedule);
        display::register_display(world, schedule);
        world.resource<scene::ViewSettings>().size = {width, height};
        world.resource<temporal::TemporalSettings>().enabled = false;
        camera = world.spawn(
            scene::LocalTransform{}, scene::WorldTransform{}, scene::PreviousWorldTransform{},
            scene::Camera{.vertical_fov = 0.8f, .near_plane = 0.05f}, scene::ActiveCamera{});
        executor = std::move(*graph::Executor::create(device, scene::kFramesInFlight));
        auto buffer = gpu::Buffer::create(device, uint64_t{8} * width * height,
                                          gpu::MemoryKind::kReadback, "test readback");
        EXPECT_TRUE(buffer);
        readback_ = std::move(*buffer);
    }
    ~HairScene() { static_cast<void>(executor->wait()); }
    HairScene(const HairScene&) = delete;
    HairScene& operator=(const HairScene&) = delete;

    Entity add_hair(const hair::StrandData& strands, const hair::HairExtension& look = {},
                    const hair::HairTechniques& techniques = {}) {
        auto groom = hair::add_strands(world, device_, "test", strands, {});
        EXPECT_TRUE(groom);
        return hair::spawn_hair(world, *groom, look, techniques, kNoEntity);
    }
    /// A sun of white irradiance 1; `to_sun` is unit.
    Entity add_sun(glm::vec3 to_sun) {
        const glm::vec3 axis = glm::cross(glm::vec3(0, 0, 1), to_sun);
        const glm::quat turn =
            glm::normalize(glm::quat(1.0f + glm::dot(glm::vec3(0, 0, 1), to_sun), axis));
        return world.spawn(scene::LocalTransform{.rotation = turn}, scene::WorldTransform{},
                           scene::PreviousWorldTransform{},
                           scene::Light{.kind = asset::LightKind::kDirectional});
    }
    void build() {
        auto built = schedule.build(world);
        ASSERT_TRUE(built) << built.error().message();
    }
    /// One frame; its linear picture before TAA and tone map, as RGBA half floats unpacked.
    std::vector<glm::vec4> draw() {
        std::vector<glm::vec4> pixels(render(&scene::RenderFrame::color));
        const auto* halves = reinterpret_cast<const uint64_t*>(readback_.mapped());
        for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = glm::unpackHalf4x16(halves[i]);
        return pixels;
    }
    /// One frame; how far what it shows moved since the last one, in pixels.
    std::vector<glm::vec2> draw_velocity() {
        std::vector<glm::vec2> pixels(render(&scene::RenderFrame::velocity));
        const auto* halves = reinterpret_cast<const uint32_t*>(readback_.mapped());
        for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = glm::unpackHalf2x16(halves[i]);
        return pixels;
    }

    World world;
    Schedule schedule{"frame"};
    Entity camera;
    std::unique_ptr<graph::Executor> executor;

  private:
    using Picture = graph::ImageHandle scene::RenderFrame::*;

    /// Draws a frame, one picture of it into readback_; how many pixels it has.
    size_t render(Picture picture) {
        EXPECT_TRUE(executor->begin_frame());
        schedule.run(world);
        auto& frame = world.resource<scene::RenderFrame>();
        EXPECT_FALSE(frame.error) << frame.error->message();
        display::describe_readback(frame, frame.*picture, readback_);
        frame.graph.output(frame.display);
        auto done = executor->execute(frame.graph);
        EXPECT_TRUE(done) << done.error().message();
        EXPECT_TRUE(executor->wait());
        ++world.resource<scene::FixedStep>().frame;
        return size_t{frame.size.x} * frame.size.y;
    }
    gpu::Device& device_;
    gpu::Buffer readback_;
};

}  // namespace vellus::test
