#include "modules/scene/view.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/ecs/schedule.h"
#include "modules/scene/register.h"

namespace vellus::scene {
namespace {

/// Pixel position by plain trigonometry: distances along the camera's axes, no matrices.
glm::dvec2 pixel_by_hand(const CameraPose& pose, glm::uvec2 size, const glm::dvec3& point) {
    const glm::dvec3 offset = point - pose.position;
    const double depth = -glm::dot(offset, pose.axes[2]);
    const double focal = 0.5 * size.y / std::tan(0.5 * pose.vertical_fov);
    return {0.5 * size.x + focal * glm::dot(offset, pose.axes[0]) / depth,
            0.5 * size.y - focal * glm::dot(offset, pose.axes[1]) / depth};
}

glm::dvec2 to_pixel(const glm::vec4& clip, glm::uvec2 size) {
    const glm::dvec2 ndc = glm::dvec2(clip.x, clip.y) / static_cast<double>(clip.w);
    return (ndc * 0.5 + 0.5) * glm::dvec2(size);
}

CameraPose random_pose(std::mt19937& random, const glm::dvec3& at) {
    std::uniform_real_distribution<double> angle(-1.4, 1.4);
    CameraPose pose = orbit_pose(at, 3.0, 2.0 * angle(random), angle(random), 0.7f);
    pose.near_plane = 0.05f;
    return pose;
}

TEST(View, ProjectsLikeTrigonometryAndUnprojectsBack) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const CameraPose pose = random_pose(random, {5, 6, 7});
        ViewSettings settings;
        settings.size = {640, 480};
        settings.jitter = {0.3f, -0.2f};
        const View view = make_view(pose, std::nullopt, settings, {});
        const glm::dvec3 point =
            glm::dvec3(5, 6, 7) + glm::dvec3(unit(random), unit(random), unit(random));
        const glm::vec4 rel(glm::vec3(point - pose.position), 1.0f);
        const glm::dvec2 expected = pixel_by_hand(pose, settings.size, point);
        const glm::vec4 clip = view.view_projection * rel;
        const glm::dvec2 pixel = to_pixel(clip, settings.size);
        // 640 pixels x float's 6e-8, a few operations deep.
        EXPECT_LT(glm::length(pixel - expected - glm::dvec2(0.3, -0.2)), 1e-3);
        const glm::vec4 still = view.view_projection_unjittered * rel;
        EXPECT_LT(glm::length(to_pixel(still, settings.size) - expected), 1e-3);
        const glm::vec3 back = glsl::view_position(view, glm::vec2(pixel), clip.z / clip.w);
        EXPECT_LT(glm::length(back - glm::vec3(rel)), 2e-5f);
    }
}

TEST(View, DepthIsReversedAndInfinite) {
    CameraPose pose;
    pose.near_plane = 0.1f;
    const View view = make_view(pose, std::nullopt, {}, {});
    const auto depth_at = [&](float metres) {
        const glm::vec4 clip = view.view_projection * glm::vec4(0, 0, -metres, 1);
        return clip.z / clip.w;
    };
    EXPECT_FLOAT_EQ(depth_at(0.1f), 1.0f);
    EXPECT_FLOAT_EQ(depth_at(10.0f), 0.01f);
    EXPECT_GT(depth_at(1e30f), 0.0f);
    EXPECT_FLOAT_EQ(glsl::view_distance(view, depth_at(123.0f)), 123.0f);
}

TEST(View, PreviousProjectionTakesPositionsRelativeToThisFramesCamera) {
    std::mt19937 random(2);
    const glm::dvec3 far_away(1e6, 0.0, -1e6);
    const CameraPose before = random_pose(random, far_away);
    const CameraPose now = random_pose(random, far_away + glm::dvec3(0.1, 0.0, 0.05));
    ViewSettings settings;
    settings.jitter = {0.4f, 0.4f};
    const View view = make_view(now, before, settings, {});
    EXPECT_EQ(view.cut, 0u);
    const glm::dvec3 point = far_away + glm::dvec3(0.02, 0.03, 0.01);
    const glm::vec4 rel(glm::vec3(point - now.position), 1.0f);
    const glm::vec4 clip = view.previous_view_projection * rel;
    const glm::dvec2 then = pixel_by_hand(before, settings.size, point);
    // 1280 pixels, float matrices after the subtraction in double.
    EXPECT_LT(glm::length(to_pixel(clip, settings.size) - then), 2e-3);
    const glm::dvec2 moved = pixel_by_hand(now, settings.size, point) - then;
    const glm::vec2 velocity =
        glsl::view_velocity(view, view.view_projection_unjittered * rel, clip);
    EXPECT_LT(glm::length(glm::dvec2(velocity) - moved), 2e-3);
}

TEST(View, PixelAngleIsOnePixelAtOneMetre) {
    const CameraPose pose;
    const ViewSettings settings;
    const View view = make_view(pose, std::nullopt, settings, {});
    const glm::dvec2 a = pixel_by_hand(pose, settings.size, {0, 0, -1});
    const glm::dvec2 b = pixel_by_hand(pose, settings.size, {0, view.pixel_angle, -1});
    EXPECT_NEAR(a.y - b.y, 1.0, 1e-5);
}

TEST(View, SystemFollowsTheActiveCameraAndForgetsAtACut) {
    World world;
    Schedule schedule("test");
    register_scene(world, schedule);
    ASSERT_TRUE(schedule.build(world));
    (void)world.spawn(LocalTransform{{9, 9, 9}}, WorldTransform{}, PreviousWorldTransform{},
                      Camera{});
    const Entity camera = world.spawn(LocalTransform{{1, 0, 0}}, WorldTransform{},
                                      PreviousWorldTransform{}, Camera{}, ActiveCamera{});
    const ViewState& state = world.resource<ViewState>();
    auto& step = world.resource<FixedStep>();
    const auto frame = [&](double x, bool cut) {
        world.get<LocalTransform>(camera)->translation.x = x;
        world.resource<ViewSettings>().cut = cut;
        schedule.run(world);
        ++step.frame;
    };
    frame(1.0, false);
    EXPECT_EQ(state.view.cut, 1u);
    frame(3.0, false);
    EXPECT_EQ(state.view.cut, 0u);
    EXPECT_EQ(state.view.camera_delta, glm::vec3(2, 0, 0));
    EXPECT_EQ(state.pose.position, glm::dvec3(3, 0, 0));
    EXPECT_EQ(state.relative({3, 4, 0}), glm::vec3(0, 4, 0));
    frame(50.0, true);
    EXPECT_EQ(state.view.cut, 1u);
    EXPECT_EQ(state.view.camera_delta, glm::vec3(0));
    frame(50.5, false);
    EXPECT_EQ(state.view.camera_delta, glm::vec3(0.5, 0, 0));
    EXPECT_EQ(state.view.frame_index, 3u);
}

TEST(Camera, PoseIgnoresScaleAndSurvivesALocalTransform) {
    const glm::dmat4 world(glm::dvec4(0, 0, -2, 0), glm::dvec4(0, 3, 0, 0), glm::dvec4(4, 0, 0, 0),
                           glm::dvec4(7, 8, 9, 1));
    const CameraPose pose = camera_pose({}, world);
    EXPECT_EQ(pose.position, glm::dvec3(7, 8, 9));
    EXPECT_LT(glm::length(-pose.axes[2] - glm::dvec3(-1, 0, 0)), 1e-12);  // looks along -X
    EXPECT_NEAR(glm::determinant(pose.axes), 1.0, 1e-12);
    const LocalTransform local = local_transform(pose);
    const glm::dvec3 forward(local.rotation * glm::vec3(0, 0, -1));
    EXPECT_LT(glm::length(forward + pose.axes[2]), 1e-6);
}

TEST(Camera, FramingPutsTheBoxInsideAndFillsTheTighterAxis) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto random_point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 center = 1e3 * random_point();
        const double size = std::pow(10.0, 4.0 * unit(random) - 2.0);
        Box box;
        box.include(center + size * random_point());
        box.include(center + size * random_point());
        const glm::uvec2 pixels(64 + random() % 1000, 64 + random() % 1000);
        const double fill = 0.3 + 0.7 * unit(random);
        const CameraPose pose = frame_box(box, 6.0 * unit(random), 3.0 * unit(random) - 1.5,
                                          static_cast<double>(pixels.x) / pixels.y, fill, 0.6f);
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        double nearest = 1e9;
        double farthest = 0.0;
        for (const glm::dvec3& corner : box.corners()) {
            const double depth = -glm::dot(corner - pose.position, pose.axes[2]);
            ASSERT_GT(depth, pose.near_plane);
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
            const glm::dvec2 ndc =
                pixel_by_hand(pose, pixels, corner) / glm::dvec2(pixels) * 2.0 - 1.0;
            low = glm::min(low, ndc);
            high = glm::max(high, ndc);
        }
        EXPECT_GT(std::min(low.x, low.y), -fill - 1e-6) << i;
        EXPECT_LT(std::max(high.x, high.y), fill + 1e-6) << i;
        // One axis decides how near the camera may come: there both sides are touched. Only of a
        // thin box seen end-on it keeps 5 % of the depth range away.
        if (nearest < 0.051 * (farthest - nearest)) continue;
        EXPECT_NEAR(std::max(high.x - low.x, high.y - low.y), 2.0 * fill, 1e-6) << i;
    }
}

TEST(Camera, FramingOfNothingOrOnePointIsFinite) {
    EXPECT_EQ(frame_box({}, 0, 0, 1.0).position, glm::dvec3(0, 0, 1));
    const glm::dvec3 point(3, 4, 5);
    const CameraPose pose = frame_points({&point, 1}, 0.0, 0.0, 1.0);
    EXPECT_GT(pose.near_plane, 0.0f);
    EXPECT_NEAR(pose.position.z - 5.0, 1e-3, 1e-9);
}

TEST(Bounds, TransformedBoxContainsTransformedCornersTightly) {
    const glm::dmat4 m(glm::dvec4(1, 2, 0, 0), glm::dvec4(-2, 1, 0.5, 0), glm::dvec4(0, 0, -3, 0),
                       glm::dvec4(10, 20, 30, 1));
    const Box box{{-1, -2, -3}, {4, 5, 6}};
    Box expected;
    for (const auto& corner : box.corners()) {
        expected.include(glm::dvec3(m * glm::dvec4(corner, 1)));
    }
    EXPECT_LT(glm::length(transform(m, box).min - expected.min), 1e-12);
    EXPECT_LT(glm::length(transform(m, box).max - expected.max), 1e-12);
    EXPECT_TRUE(transform(m, Box{}).empty());
}

}  // namespace
}  // namespace vellus::scene
