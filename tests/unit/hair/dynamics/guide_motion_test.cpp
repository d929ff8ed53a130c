#include "modules/hair/dynamics/guide_motion.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <functional>
#include <limits>

#include "tests/unit/hair/dynamics/guide_samples.h"

// Guides over whole frames: the clock, hard cases, colliders, sleep.
namespace vellus::hair {
namespace {

using test::all_finite;
using test::distance_from_rest;
using test::length_error;
using test::roots_on;
using test::sample_hair;
using test::turn_about;

// Quaternions are unit to 1e-7 and lengths differences of sums of 15 floats of up to 0.3 m.
constexpr double kLengthError = 2e-5;

struct Pose {
    glm::dvec3 place{0.0};
    glm::dquat turn{1, 0, 0, 0};
};

GuideMotion make_motion(uint32_t count = 32) {
    return GuideMotion(make_guides(sample_hair(count)));
}

/// A head in the frame: one frame of `dt` that ends at `pose`.
void advance(GuideMotion& motion, double dt, const Pose& pose, MotionFrame frame = {},
             const MotionSettings& settings = {}) {
    const auto roots = roots_on(motion.guides(), pose.place, pose.turn);
    frame.dt = dt;
    frame.roots = roots;
    motion.advance(settings, frame);
}

/// Frames of 1/60 s at `pose`; how long until nothing moves faster than 5 mm/s any more.
double settle(GuideMotion& motion, const Pose& pose, double seconds) {
    double moving_until = 0.0;
    for (int frame = 1; frame <= seconds * 60.0; ++frame) {
        advance(motion, 1.0 / 60.0, pose);
        EXPECT_TRUE(all_finite(motion.state()));
        EXPECT_LT(length_error(motion.guides(), motion.state()), kLengthError);
        for (const float v : motion.state().velocity.data) {
            if (std::abs(v) > 0.005f) moving_until = frame / 60.0;
        }
    }
    return moving_until;
}

/// Nods, turns and walks.
Pose wander(double t) {
    return {{0.3 * std::sin(2.0 * t), 0.05 * std::sin(9.0 * t), 1.4 * t},
            turn_about({0, 1, 0}, 0.9 * std::sin(3.0 * t)) *
                turn_about({1, 0, 0}, 0.4 * std::sin(4.1 * t))};
}

TEST(GuideMotion, LinksKeepTheirLengthHoweverTheHeadMoves) {
    GuideMotion motion = make_motion(64);
    double swung = 0.0;
    for (int frame = 0; frame < 300; ++frame) {
        advance(motion, 1.0 / 60.0, wander(frame / 60.0));
        ASSERT_TRUE(all_finite(motion.state()));
        ASSERT_LT(length_error(motion.guides(), motion.state()), kLengthError) << frame;
        swung = std::max(swung, distance_from_rest(motion.guides(), motion.state()));
    }
    EXPECT_GT(swung, 0.03) << "hair that does not swing proves nothing";
}

/// Tips in their roots' frames after `seconds` of wandering at a frame rate.
std::vector<glm::vec3> tips_after(double seconds, int rate) {
    GuideMotion motion = make_motion(48);
    advance(motion, 0.0, wander(0.0));
    for (int frame = 1; frame <= std::lround(seconds * rate); ++frame) {
        advance(motion, 1.0 / rate, wander(static_cast<double>(frame) / rate));
    }
    std::vector<glm::vec3> tips;
    for (uint32_t g = 0; g < motion.guides().count; ++g) {
        tips.push_back(guide_points(motion.guides(), motion.state(), g).back());
    }
    return tips;
}

TEST(GuideMotion, FrameRateDoesNotMatter) {
    const auto expected = tips_after(2.0, 240);
    for (const int rate : {30, 60, 144}) {
        const auto tips = tips_after(2.0, rate);
        double worst = 0.0;
        for (size_t i = 0; i < tips.size(); ++i) {
            worst = std::max(worst, static_cast<double>(glm::distance(tips[i], expected[i])));
        }
        // All that differs is the head's path, straight between frames: at 30 Hz its corner cuts
        // are 1/2 (1/60)² of the acceleration, 2 mm at the scalp; the state a step of 1/240 s.
        EXPECT_LT(worst, rate == 30 ? 0.006 : 0.003) << rate << " Hz";
    }
}

TEST(GuideMotion, TheSameTwiceAndOnOneCore) {
    const auto run = [](uint32_t count) {
        GuideMotion motion = make_motion(count);
        for (int frame = 0; frame < 90; ++frame) {
            advance(motion, 1.0 / 60.0, wander(frame / 60.0),
                    {.time = frame / 60.0, .wind = {{3.0f, 0.0f, 0.0f}, 0.7f}});
        }
        return motion.state();
    };
    const GuideState first = run(41);
    const GuideState second = run(41);
    EXPECT_EQ(first.rotation.data, second.rotation.data);
    EXPECT_EQ(first.velocity.data, second.velocity.data);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(first.rotation.data, run(41).rotation.data);
    // Nor does it matter which guides share lanes: the first 38 of 41 are 38 alone.
    const GuideState fewer = run(38);
    for (uint32_t link = 0; link < first.rotation.links; ++link) {
        for (uint32_t guide = 0; guide < 38; ++guide) {
            EXPECT_EQ(first.rotation.at(0, link)[guide], fewer.rotation.at(0, link)[guide]);
        }
    }
}

TEST(GuideMotion, TeleportsAreNotFelt) {
    GuideMotion motion = make_motion();
    settle(motion, {}, 0.5);
    // Told so.
    const Pose there{{300.0, 20.0, -50.0}, turn_about({0, 1, 0}, 2.0)};
    advance(motion, 1.0 / 60.0, there, {.teleported = true});
    EXPECT_LT(distance_from_rest(motion.guides(), motion.state()), 0.002);
    // Not told: 400 m in a sixtieth of a second can be nothing else.
    advance(motion, 1.0 / 60.0, {});
    EXPECT_LT(distance_from_rest(motion.guides(), motion.state()), 0.002);
    EXPECT_EQ(motion.counts().carried, 2u);
    EXPECT_LT(settle(motion, {}, 3.0), 2.0);
    EXPECT_LT(distance_from_rest(motion.guides(), motion.state()), 1e-3);
}

TEST(GuideMotion, HalfATurnInOneFrame) {
    GuideMotion motion = make_motion();
    settle(motion, {}, 0.5);
    for (const double angle : {3.14159265358979, 0.0, 3.0, -3.0}) {
        const Pose turned{{0, 0, 0}, turn_about({0, 1, 0}, angle)};
        advance(motion, 1.0 / 60.0, turned);
        EXPECT_TRUE(all_finite(motion.state()));
        EXPECT_LT(length_error(motion.guides(), motion.state()), kLengthError);
        EXPECT_LT(settle(motion, turned, 3.0), 2.0) << angle;
        EXPECT_LT(distance_from_rest(motion.guides(), motion.state()), 2e-3) << angle;
    }
}

TEST(GuideMotion, AnyFrameTime) {
    GuideMotion motion = make_motion();
    const Pose moved{{0.1, 0, 0}, turn_about({0, 1, 0}, 0.8)};
    for (const double dt : {0.0, 1e-6, 1.0, 1e9, -1.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()}) {
        for (int frame = 0; frame < 20; ++frame) {
            advance(motion, dt, frame % 2 == 0 ? moved : Pose{});
            ASSERT_TRUE(all_finite(motion.state())) << dt;
            ASSERT_LT(length_error(motion.guides(), motion.state()), kLengthError) << dt;
        }
        EXPECT_LT(settle(motion, {}, 2.5), 2.0) << dt;
        EXPECT_LT(distance_from_rest(motion.guides(), motion.state()), 2e-3) << dt;
    }
}

TEST(GuideMotion, MicrosecondsAddUpToFrames) {
    GuideMotion fine = make_motion(4);
    GuideMotion coarse = make_motion(4);
    const Pose moved{{0.05, 0, 0.02}};
    advance(fine, 0.0, {});
    advance(coarse, 0.0, {});
    advance(coarse, 0.05, moved);
    for (int i = 1; i <= 50000; ++i) {
        advance(fine, 1e-6, {i / 50000.0 * moved.place});
    }
    EXPECT_EQ(fine.counts().guide_steps, coarse.counts().guide_steps);
    for (uint32_t g = 0; g < 4; ++g) {
        const auto a = guide_points(fine.guides(), fine.state(), g);
        const auto b = guide_points(coarse.guides(), coarse.state(), g);
        // The same path in pieces: only their places in float differ.
        EXPECT_LT(glm::distance(a.back(), b.back()), 1e-5);
    }
}

TEST(GuideMotion, LinksWithoutLength) {
    // A strand that is a point, one with all its points but two in one place, one as short as a
    // pore, beside one like any other.
    std::vector<test::Strand> strands = sample_hair(5);
    strands[1] = test::Strand(6, glm::vec3(0.0f, 0.1f, 0.0f));
    strands[2] = {{0, 0.1f, 0}, {0, 0.1f, 0}, {0, 0.1f, 0}, {0, 0.3f, 0}, {0, 0.3f, 0}};
    strands[3] = {{0, 0.1f, 0}, {0, 0.1f + 1e-5f, 0}};
    GuideSet guides = make_guides(strands);
    // Links of one strand that differ: zero in between.
    for (uint32_t i = 3; i < 6; ++i) {
        for (uint32_t c = 0; c < 3; ++c) guides.rest.at(c, i)[2] = 0.0f;
    }
    GuideMotion motion(std::move(guides));
    for (int frame = 0; frame < 120; ++frame) {
        advance(motion, 1.0 / 60.0, wander(frame / 60.0));
        ASSERT_TRUE(all_finite(motion.state())) << frame;
        ASSERT_LT(length_error(motion.guides(), motion.state()), 1e-3) << frame;
    }
    EXPECT_LT(settle(motion, wander(119 / 60.0), 2.5), 2.0);
}

TEST(GuideMotion, AMillionMetresAwayItIsTheSame) {
    const auto run = [](const glm::dvec3& offset) {
        GuideMotion motion = make_motion();
        for (int frame = 0; frame < 120; ++frame) {
            Pose pose = wander(frame / 60.0);
            const glm::dvec3 head = pose.place + offset;
            pose.place = head;
            const std::vector<WorldCapsule> capsules{{head, head, 0.08}};
            advance(motion, 1.0 / 60.0, pose, {.capsules = capsules});
        }
        return motion;
    };
    const GuideMotion here = run(glm::dvec3(0.0));
    const GuideMotion there = run({1e6, -1e6, 1e6});
    for (uint32_t g = 0; g < here.guides().count; ++g) {
        const auto a = guide_points(here.guides(), here.state(), g);
        const auto b = guide_points(there.guides(), there.state(), g);
        // A double holds 1e6 m to 1.2e-10 m, which a step of 1/240 s makes 3e-8 m/s of velocity.
        EXPECT_LT(glm::distance(a.back(), b.back()), 2e-5) << g;
    }
}

TEST(GuideMotion, NodeScaleChangesUnitsOnly) {
    // The same hair in centimetres under a node that scales it by 0.01.
    const auto strands = sample_hair(8);
    auto in_cm = strands;
    for (auto& strand : in_cm) {
        for (auto& p : strand) p *= 100.0f;
    }
    GuideSet metres = make_guides(strands);
    GuideSet centimetres = make_guides(in_cm);
    GuideMotion a(metres);
    GuideMotion b(centimetres);
    for (int frame = 0; frame < 90; ++frame) {
        const Pose pose = wander(frame / 60.0);
        const auto roots = roots_on(metres, pose.place, pose.turn);
        const std::vector<WorldCapsule> head{{pose.place, pose.place, 0.085}};
        MotionFrame now{.dt = 1.0 / 60.0, .roots = roots, .capsules = head};
        now.wind.velocity = {1.0f, 0.0f, 0.0f};
        now.wind.gust = 0.0f;
        a.advance({}, now);
        now.scale = 0.01;
        b.advance({}, now);
    }
    for (uint32_t g = 0; g < metres.count; ++g) {
        const auto p = guide_points(metres, a.state(), g);
        const auto q = guide_points(centimetres, b.state(), g);
        EXPECT_LT(glm::distance(p.back(), q.back() * 0.01f), 2e-4) << g;
    }
}

/// Deepest that points of links from the third on lie inside a capsule (nearer the root they may).
double deepest(const GuideMotion& motion, const Pose& pose, const WorldCapsule& capsule) {
    double worst = 0.0;
    for (uint32_t g = 0; g < motion.guides().count; ++g) {
        const auto points = guide_points(motion.guides(), motion.state(), g);
        for (size_t i = 3; i < points.size(); ++i) {
            const glm::dvec3 p = pose.place + pose.turn * (glm::dvec3(motion.guides().root[g]) +
                                                           glm::dvec3(points[i]));
            const glm::dvec3 axis = capsule.b - capsule.a;
            const double t = glm::clamp(
                glm::dot(p - capsule.a, axis) / std::max(glm::dot(axis, axis), 1e-12), 0.0, 1.0);
            worst = std::max(worst, capsule.radius - glm::distance(p, capsule.a + t * axis));
        }
    }
    return worst;
}

TEST(GuideMotion, CollidersAreNotEntered) {
    GuideMotion motion = make_motion(96);
    double worst = 0.0;
    uint32_t touching = 0;
    for (int frame = 0; frame < 240; ++frame) {
        const double t = frame / 60.0;
        // The head turns and tips; a shoulder below and an arm that sweeps through the hair.
        const Pose pose{{0.0, 0.0, 0.0},
                        turn_about({0, 1, 0}, 1.2 * std::sin(4.0 * t)) *
                            turn_about({1, 0, 0}, 0.6 * std::sin(3.0 * t))};
        const glm::dvec3 hand(0.16 * std::cos(3.0 * t), -0.05, 0.16 * std::sin(3.0 * t));
        const std::vector<WorldCapsule> capsules{
            {{0, 0, 0}, {0, 0, 0}, 0.088, 1},
            {{-0.2, -0.22, 0}, {0.2, -0.22, 0}, 0.06, 2},
            {hand, hand + glm::dvec3(0.0, -0.2, 0.0), 0.03, 3}};
        advance(motion, 1.0 / 60.0, pose, {.capsules = capsules});
        ASSERT_TRUE(all_finite(motion.state()));
        for (const WorldCapsule& capsule : capsules) {
            const double depth = deepest(motion, pose, capsule);
            touching += depth > -0.001 ? 1 : 0;
            worst = std::max(worst, depth);
        }
    }
    EXPECT_GT(touching, 200u);
    // A millimetre: twelve hairs; an eighth of the smallest collider's radius squeezed between two.
    EXPECT_LT(worst, 1e-3);
}

TEST(GuideMotion, SleepsAndWakes) {
    GuideMotion motion = make_motion(16);
    const std::vector<WorldCapsule> head{{{0, 0, 0}, {0, 0, 0}, 0.05}};
    const MotionFrame still{.capsules = head};
    const auto steps_of = [&](const auto& frame) {
        const uint64_t before = motion.counts().guide_steps;
        frame();
        return motion.counts().guide_steps - before;
    };
    for (int frame = 0; frame < 60; ++frame) advance(motion, 1.0 / 60.0, {}, still);
    ASSERT_TRUE(motion.asleep()) << "hair at rest falls asleep within a second";
    EXPECT_EQ(steps_of([&] {
                  for (int i = 0; i < 100; ++i) advance(motion, 1.0 / 60.0, {}, still);
              }),
              0u);
    EXPECT_EQ(motion.counts().asleep, 100u + 60u - motion.counts().frames);

    const auto fall_asleep = [&](const Pose& pose, const MotionFrame& frame,
                                 const MotionSettings& settings) {
        for (int i = 0; i < 600 && !motion.asleep(); ++i) {
            advance(motion, 1.0 / 60.0, pose, frame, settings);
        }
        ASSERT_TRUE(motion.asleep());
    };
    const Pose moved{{0.01, 0, 0}};
    const Pose turned{{0.01, 0, 0}, turn_about({0, 0, 1}, 0.01)};
    EXPECT_EQ(steps_of([&] { advance(motion, 1.0 / 60.0, moved, still); }), 16u * 4u);
    fall_asleep(moved, still, {});
    EXPECT_EQ(steps_of([&] { advance(motion, 1.0 / 60.0, turned, still); }), 16u * 4u);
    fall_asleep(turned, still, {});
    EXPECT_EQ(
        steps_of([&] {
            advance(motion, 1.0 / 60.0, turned, {.capsules = head, .wind = {{0.5f, 0, 0}, 0.0f}});
        }),
        16u * 4u)
        << "wind";
    fall_asleep(turned, still, {});
    const std::vector<WorldCapsule> nearer{{{0, 0.01, 0}, {0, 0, 0}, 0.05}};
    EXPECT_EQ(steps_of([&] { advance(motion, 1.0 / 60.0, turned, {.capsules = nearer}); }),
              16u * 4u)
        << "collider";
    fall_asleep(turned, {.capsules = nearer}, {});
    const MotionSettings softer{.bend_length = 0.05f};
    EXPECT_EQ(steps_of([&] { advance(motion, 1.0 / 60.0, turned, {.capsules = nearer}, softer); }),
              16u * 4u)
        << "settings";
}

TEST(GuideMotion, WindBlowsHairDownwind) {
    GuideMotion motion = make_motion(24);
    for (int frame = 0; frame < 180; ++frame) {
        advance(motion, 1.0 / 60.0, {}, {.time = frame / 60.0, .wind = {{4.0f, 0, 0}, 0.4f}});
    }
    double downwind = 0.0;
    const GuideState rest = rest_state(motion.guides());
    for (uint32_t g = 0; g < 24; ++g) {
        downwind += guide_points(motion.guides(), motion.state(), g).back().x -
                    guide_points(motion.guides(), rest, g).back().x;
    }
    EXPECT_GT(downwind / 24.0, 0.02);
    EXPECT_FALSE(motion.asleep());
}

}  // namespace
}  // namespace vellus::hair
