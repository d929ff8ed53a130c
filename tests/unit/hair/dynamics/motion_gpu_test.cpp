#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "modules/hair/binding/deform_passes.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/dynamics/move_passes.h"
#include "modules/hair/dynamics/simulate.h"
#include "tests/support/hair_scene.h"
#include "tests/unit/hair/dynamics/guide_samples.h"

// The device's solver against the processor's, and motion in whole frames of a scene.
namespace vellus::hair {
namespace {

using vellus::test::HairScene;
using MotionGpu = vellus::test::GpuTest;

constexpr uint32_t kSize = 96;

glm::vec3 tip(const GuideSet& guides, const GuideState& state, uint32_t guide) {
    return guide_points(guides, state, guide).back();
}

/// State as the device left it.
GuideState read_state(gpu::Device& device, const DeviceGuides& guides, GuideState shape) {
    std::vector<float> columns(shape.rotation.data.size() + shape.velocity.data.size() +
                               shape.tension.data.size());
    EXPECT_TRUE(guides.state.read_back(device, std::as_writable_bytes(std::span(columns))));
    auto from = columns.begin();
    for (GuideColumns* column : {&shape.rotation, &shape.velocity, &shape.tension}) {
        const auto size = static_cast<ptrdiff_t>(column->data.size());
        std::copy(from, from + size, column->data.begin());
        from += size;
    }
    return shape;
}

TEST_F(MotionGpu, DeviceAndProcessorAgree) {
    GuideSet guides = make_guides(test::sample_hair(77));
    test::preload_upright(guides);
    GuideState here = rest_state(guides);
    auto there = DeviceGuides::upload(device(), guides, here);
    ASSERT_TRUE(there) << there.error().message();
    auto pipeline = device().pipelines().compute(
        {.shader = "hair/dynamics/solve.comp.glsl", .push_bytes = sizeof(SolvePush)});
    ASSERT_TRUE(pipeline) << pipeline.error().message();

    MotionWork work;
    work.params = test::sample_params();
    work.params.wind = {2.0f, 0.0f, 1.0f};
    work.params.gust = 0.5f;
    work.params.gust_rate = {0.001f, 0.003f, 0.007f};
    work.params.capsules = 2;
    work.capsules = {
        {.a0 = {0, 0, 0}, .radius = 0.085f, .b0 = {0, 0, 0}, .a1 = {0, 0, 0}, .b1 = {0, 0, 0}},
        {.a0 = {-0.2f, -0.22f, 0},
         .radius = 0.06f,
         .b0 = {0.2f, -0.22f, 0},
         .a1 = {-0.2f, -0.22f, 0},
         .b1 = {0.2f, -0.22f, 0}}};
    const std::vector<RootPose> shown(guides.count);
    glm::dquat before(1, 0, 0, 0);
    double swung = 0.0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        const glm::dquat now = test::turn_about({0.2, 1, 0}, 0.8 * std::sin(0.1 * (frame + 1)));
        work.roots.clear();
        for (uint32_t g = 0; g < guides.count; ++g) {
            const glm::dvec3 root(guides.root[g]);
            work.roots.push_back({.turn = test::to_vec4(before),
                                  .spin = test::spin_between(before, now, work.params.substeps),
                                  .place0 = glm::vec3(before * root),
                                  .place1 = glm::vec3(now * root)});
        }
        before = now;
        simulate(guides, work.params, work.roots, work.capsules, here);
        swung = std::max(swung, test::distance_from_rest(guides, here));
        const SolvePush push = there->write(frame % kTurnSlots, work, shown);
        ASSERT_TRUE(device().submit_now("solve", [&](VkCommandBuffer handle) {
            gpu::CommandBuffer commands(handle);
            commands.bind(**pipeline);
            commands.push(push);
            commands.dispatch_threads(push.count, 64);
        }));
    }
    const GuideState device_state = read_state(device(), *there, here);
    double worst = 0.0;
    for (uint32_t g = 0; g < guides.count; ++g) {
        worst = std::max(worst, static_cast<double>(glm::distance(tip(guides, here, g),
                                                                  tip(guides, device_state, g))));
    }
    // Rounding differs (fused multiply-add, division), and contacts switch a step sooner or later.
    EXPECT_LT(worst, 5e-4);
    EXPECT_GT(swung, 0.03);
    EXPECT_LT(test::length_error(guides, device_state), 2e-5);
}

/// A curtain of strands hanging before the camera.
StrandData curtain(int strands = 40) {
    std::vector<std::vector<glm::vec3>> lines;
    for (int s = 0; s < strands; ++s) {
        const float x = -0.1f + 0.2f * static_cast<float>(s) / static_cast<float>(strands - 1);
        std::vector<glm::vec3> line;
        for (int i = 0; i < 16; ++i) {
            const float t = static_cast<float>(i) / 15.0f;
            line.emplace_back(x + 0.01f * std::sin(12.0f * t), 0.15f - 0.25f * t,
                              -1.0f + 0.01f * std::cos(12.0f * t));
        }
        lines.push_back(line);
    }
    return vellus::test::make_strands(lines, 0.004f);
}

struct Scene {
    explicit Scene(gpu::Device& device) : scene(device, kSize, kSize) {
        scene.add_sun({0, 0, 1});
        hair = scene.add_hair(curtain());
    }
    void move(gpu::Device& device, MotionSolver solver = MotionSolver::kProcessor) {
        HairMotion motion;
        motion.solver = solver;
        ASSERT_TRUE(add_motion(scene.world, device, hair, motion, 12));
    }
    HairMotion& motion() { return *scene.world.get<HairMotion>(hair); }
    GroomMotion& groom() { return *scene.world.resource<HairMotions>().list[motion().slot]; }
    scene::LocalTransform& place() { return *scene.world.get<scene::LocalTransform>(hair); }
    size_t passes(std::string_view prefix) {
        const auto& report = scene.executor->report();
        return static_cast<size_t>(std::ranges::count_if(
            report.passes, [&](const auto& pass) { return pass.name.starts_with(prefix); }));
    }
    uint64_t steps() { return groom().motion.counts().guide_steps; }
    /// Points of this frame as drawn, metres from the deform's anchor.
    std::vector<glm::vec3> drawn(gpu::Device& device) {
        const auto& frame = scene.world.resource<HairFrame>();
        EXPECT_EQ(frame.deforms.size(), 1u);
        std::vector<glm::vec3> points(frame.deforms[0].strands->point_count);
        const auto& buffer = scene.world.resource<HairDeformation>().points;
        EXPECT_TRUE(buffer.read_back(device, std::as_writable_bytes(std::span(points))));
        return points;
    }

    HairScene scene;
    Entity hair;
};

TEST_F(MotionGpu, WithoutTheComponentNothingRuns) {
    Scene scene(device());
    scene.scene.build();
    for (int frame = 0; frame < 3; ++frame) scene.scene.draw();
    EXPECT_EQ(scene.passes("hair/move") + scene.passes("hair/solve") + scene.passes("hair/carry"),
              0u);
    EXPECT_EQ(scene.scene.world.resource<HairMotionPasses>().dispatches, 0u);
    EXPECT_EQ(scene.scene.world.resource<HairMotionPasses>().move, nullptr);
    EXPECT_EQ(scene.scene.world.resource<HairFrame>().effects[0].motion, MotionReason::kNone);
}

TEST_F(MotionGpu, StrandsSwingKeepTheirLengthsAndStayAtTheirRoots) {
    for (const MotionSolver solver : {MotionSolver::kProcessor, MotionSolver::kDevice}) {
        Scene scene(device());
        scene.move(device(), solver);
        scene.scene.build();
        const LibraryGroom& groom = scene.scene.world.resource<HairLibrary>().grooms[0];
        double swung = 0.0;
        for (int frame = 0; frame < 30; ++frame) {
            const double x = 0.05 * std::sin(0.3 * frame);
            scene.place().translation = {x, 0.0, 0.0};
            scene.scene.draw();
            if (frame % 6 != 5) continue;
            const auto points = scene.drawn(device());
            for (size_t s = 0; s + 1 < groom.strand_begin.size(); ++s) {
                const uint32_t first = groom.strand_begin[s];
                // The anchor moves with the node, so roots stay where the file has them.
                EXPECT_LT(glm::distance(points[first], groom.positions[first]), 1e-6f);
                for (uint32_t i = first + 1; i < groom.strand_begin[s + 1]; ++i) {
                    const float rest = glm::distance(groom.positions[i], groom.positions[i - 1]);
                    EXPECT_NEAR(glm::distance(points[i], points[i - 1]), rest, 1e-3f * rest);
                    swung = std::max(
                        swung, static_cast<double>(glm::distance(points[i], groom.positions[i])));
                }
            }
        }
        EXPECT_GT(swung, 0.02);
        EXPECT_EQ(scene.passes("hair/move"), 1u);
        EXPECT_EQ(scene.passes("hair/solve"), solver == MotionSolver::kDevice ? 1u : 0u);
        EXPECT_EQ(scene.motion().reason, MotionReason::kChosen);
    }
}

TEST_F(MotionGpu, OffWhereItCannotBeSeenAndThePlanSaysWhy) {
    Scene scene(device());
    scene.move(device());
    scene.scene.build();
    auto& frame = scene.scene.world.resource<HairFrame>();
    const auto draws_nothing = [&](MotionReason why) {
        scene.scene.draw();
        const uint64_t before = scene.steps();
        const uint64_t dispatched = scene.scene.world.resource<HairMotionPasses>().dispatches;
        for (int i = 0; i < 3; ++i) {
            scene.place().translation.y += 1e-3;
            scene.scene.draw();
        }
        EXPECT_EQ(frame.effects[0].motion, why);
        EXPECT_EQ(scene.steps(), before);
        EXPECT_EQ(scene.scene.world.resource<HairMotionPasses>().dispatches, dispatched);
        EXPECT_EQ(scene.passes("hair/move"), 0u);
        EXPECT_FALSE(text(why).empty());
    };
    for (int i = 0; i < 4; ++i) {
        scene.place().translation.x = 0.01 * i;
        scene.scene.draw();
    }
    EXPECT_GT(scene.steps(), 0u);
    EXPECT_EQ(frame.effects[0].motion, MotionReason::kChosen);
    scene.place().translation.z = 100.0;
    draws_nothing(MotionReason::kOutOfView);
    scene.place().translation.z = -100.0;
    draws_nothing(MotionReason::kTooSmall);
    scene.place().translation.z = 0.0;
    scene.motion().enabled = false;
    draws_nothing(MotionReason::kSwitchedOff);
    scene.motion().enabled = true;
    const uint64_t before = scene.steps();
    scene.place().translation.x += 0.01;
    scene.scene.draw();
    scene.place().translation.x += 0.01;
    scene.scene.draw();
    EXPECT_GT(scene.steps(), before);
    EXPECT_EQ(frame.effects[0].motion, MotionReason::kChosen);
}

TEST_F(MotionGpu, AsleepAtRestItCostsNothing) {
    Scene scene(device());
    scene.move(device());
    scene.scene.build();
    for (int frame = 0; frame < 90 && !scene.groom().motion.asleep(); ++frame) scene.scene.draw();
    ASSERT_TRUE(scene.groom().motion.asleep());
    scene.scene.draw();
    EXPECT_EQ(scene.motion().reason, MotionReason::kAsleep);
    const uint64_t steps = scene.steps();
    const uint64_t dispatched = scene.scene.world.resource<HairMotionPasses>().dispatches;
    for (int frame = 0; frame < 5; ++frame) scene.scene.draw();
    EXPECT_EQ(scene.steps(), steps);
    EXPECT_EQ(scene.scene.world.resource<HairMotionPasses>().dispatches, dispatched);
    EXPECT_EQ(scene.passes("hair/move") + scene.passes("hair/carry"), 0u);
    EXPECT_EQ(scene.scene.world.resource<HairFrame>().deforms.size(), 0u);
    // A breath of wind wakes it.
    scene.scene.world.resource<Wind>().velocity = {1.0f, 0.0f, 0.0f};
    scene.scene.draw();
    EXPECT_GT(scene.steps(), steps);
}

TEST_F(MotionGpu, BoundsHoldHairThatSwingsOutOfItsRest) {
    Scene scene(device());
    scene.move(device());
    scene.scene.build();
    scene.scene.world.resource<Wind>().velocity = {12.0f, 0.0f, 0.0f};
    double out = 0.0;
    for (int frame = 0; frame < 40; ++frame) {
        scene.scene.draw();
        if (frame % 10 != 9) continue;
        const scene::Box& box = scene.scene.world.get<scene::WorldBounds>(scene.hair)->box;
        const glm::dvec3 anchor = scene.scene.world.resource<HairFrame>().deforms[0].anchor;
        for (const glm::vec3& point : scene.drawn(device())) {
            const glm::dvec3 p = anchor + glm::dvec3(point);
            for (int c = 0; c < 3; ++c) {
                EXPECT_GE(p[c], box.min[c]);
                EXPECT_LE(p[c], box.max[c]);
            }
            out = std::max(out, p.x - 0.12);
        }
    }
    EXPECT_GT(out, 0.02) << "the wind should blow some hair out of its box at rest";
}

TEST_F(MotionGpu, SteadyMotionMakesNothing) {
    Scene scene(device());
    scene.move(device());
    scene.scene.build();
    const auto draw = [&](int frame) {
        scene.place().translation.x = 0.05 * std::sin(0.3 * frame);
        scene.scene.draw();
    };
    for (int frame = 0; frame < 6; ++frame) draw(frame);
    const uint64_t objects = scene.scene.executor->objects_created();
    const uint64_t bytes = device().memory().bytes_in_use();
    for (int frame = 6; frame < 16; ++frame) draw(frame);
    EXPECT_EQ(scene.scene.executor->objects_created(), objects);
    EXPECT_EQ(device().memory().bytes_in_use(), bytes);
}

}  // namespace
}  // namespace vellus::hair
