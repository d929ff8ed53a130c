#include "game_demo/src/controls.h"

#include <gtest/gtest.h>

namespace vellus::demo {
namespace {

constexpr double kHeight = 500.0;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

Input dragging(MouseButton button, double dx, double dy) {
    Input input;
    input.mouse[static_cast<size_t>(button)].held = true;
    move_cursor(input, dx, dy);
    return input;
}

TEST(Orbit, TakesOverWithoutAJump) {
    const scene::CameraPose pose = scene::orbit_pose({1.0, 2.0, -3.0}, 4.0, 2.5, -0.4, 0.7f);
    // The scene's centre need not lie on the view axis.
    const Orbit orbit = orbit_from(pose, glm::dvec3(1.0, 2.0, -3.0) + 0.5 * pose.axes[0]);
    EXPECT_NEAR(orbit.distance, 4.0, 1e-12);
    expect_near(orbit.target, {1.0, 2.0, -3.0}, 1e-12);
    const scene::CameraPose same = pose_of(orbit);
    expect_near(same.position, pose.position, 1e-12);
    for (int axis = 0; axis < 3; ++axis) expect_near(same.axes[axis], pose.axes[axis], 1e-12);
    EXPECT_EQ(same.vertical_fov, 0.7f);
}

TEST(Orbit, ACentreBehindTheCameraStillGivesATargetAhead) {
    const scene::CameraPose pose = scene::orbit_pose({0.0, 0.0, 0.0}, 1.0, 0.0, 0.0);
    const Orbit orbit = orbit_from(pose, {0.0, 0.0, 50.0});
    EXPECT_GT(orbit.distance, 0.0);
    expect_near(pose_of(orbit).position, pose.position, 1e-12);
}

TEST(Steer, TurningKeepsDistanceAndTarget) {
    Orbit orbit{.target = {1.0, 1.0, 1.0}, .distance = 3.0};
    EXPECT_TRUE(steer(orbit, dragging(MouseButton::kLeft, 40.0, 25.0), kHeight));
    EXPECT_NEAR(glm::length(pose_of(orbit).position - glm::dvec3(1.0)), 3.0, 1e-12);
    EXPECT_LT(orbit.yaw, 0.0) << "dragging right turns the subject right: the camera goes left";
    EXPECT_GT(orbit.pitch, 0.0) << "dragging down shows more of the top";
}

TEST(Steer, NoDragGoesOverThePole) {
    Orbit orbit;
    for (int i = 0; i < 100; ++i) steer(orbit, dragging(MouseButton::kLeft, 0.0, 300.0), kHeight);
    EXPECT_LT(orbit.pitch, 1.5708);
    EXPECT_GT(scene::orbit_axes(orbit.yaw, orbit.pitch)[1].y, 0.0);
}

TEST(Steer, WhatIsMovedStaysUnderThePointer) {
    Orbit orbit{.distance = 2.0, .yaw = 0.3, .pitch = 0.2, .vertical_fov = 0.9f};
    const glm::dvec3 before = orbit.target;
    steer(orbit, dragging(MouseButton::kRight, 50.0, -20.0), kHeight);
    // The old target projects 50 pixels right of the centre and 20 above it.
    const scene::CameraPose pose = pose_of(orbit);
    const glm::dvec3 seen = glm::transpose(pose.axes) * (before - pose.position);
    const double pixels_per_slope = 0.5 * kHeight / std::tan(0.5 * 0.9f);
    EXPECT_NEAR(seen.x / -seen.z * pixels_per_slope, 50.0, 1e-9);
    EXPECT_NEAR(seen.y / -seen.z * pixels_per_slope, 20.0, 1e-9);
}

TEST(Steer, TheWheelIsReversible) {
    Orbit orbit{.distance = 5.0};
    Input input;
    input.scroll_y = 3.0;
    EXPECT_TRUE(steer(orbit, input, kHeight));
    EXPECT_LT(orbit.distance, 5.0);
    input.scroll_y = -3.0;
    steer(orbit, input, kHeight);
    EXPECT_NEAR(orbit.distance, 5.0, 1e-12);
}

TEST(Steer, NothingHeldChangesNothing) {
    Orbit orbit;
    Input input;
    move_cursor(input, 100.0, 100.0);
    EXPECT_FALSE(steer(orbit, input, kHeight));
    input.gamepad.connected = true;
    input.gamepad.axes = {0.1f, 0.1f, 0.1f, -0.1f, -1.0f, -1.0f};  // resting sticks are never 0
    EXPECT_FALSE(steer(orbit, input, kHeight));
}

Input tilted(size_t axis, float value, double seconds) {
    Input input;
    input.gamepad.connected = true;
    input.gamepad.axes = {0.0f, 0.0f, 0.0f, 0.0f, -1.0f, -1.0f};
    input.gamepad.axes[axis] = value;
    input.seconds = seconds;
    return input;
}

TEST(Gamepad, TheRightStickTurnsAsFarInASecondAtAnyFrameRate) {
    Orbit slow;
    Orbit fast;
    EXPECT_TRUE(steer(slow, tilted(2, 0.6f, 0.1), kHeight));
    for (int i = 0; i < 10; ++i) steer(fast, tilted(2, 0.6f, 0.01), kHeight);
    EXPECT_NEAR(slow.yaw, fast.yaw, 1e-12);
    EXPECT_LT(slow.yaw, -0.05);
    Orbit unplugged;
    Input input = tilted(2, 0.6f, 0.1);
    input.gamepad.connected = false;
    EXPECT_FALSE(steer(unplugged, input, kHeight));
}

TEST(Gamepad, AStickStartsAtNothingBeyondItsDeadZoneAndEndsAtOne) {
    EXPECT_EQ(movement(tilted(0, 0.15f, 0.0)).x, 0.0);
    EXPECT_NEAR(movement(tilted(0, 0.16f, 0.0)).x, 0.01 / 0.85, 1e-6);
    EXPECT_EQ(movement(tilted(1, -1.0f, 0.0)), glm::dvec3(0.0, 0.0, -1.0));
}

TEST(Gamepad, TheRightTriggerComesCloserAndTheLeftGoesBack) {
    Orbit orbit{.distance = 5.0};
    EXPECT_TRUE(steer(orbit, tilted(5, 1.0f, 0.1), kHeight));
    EXPECT_LT(orbit.distance, 5.0);
    EXPECT_TRUE(steer(orbit, tilted(4, 1.0f, 0.1), kHeight));
    EXPECT_NEAR(orbit.distance, 5.0, 1e-12);
}

TEST(Gamepad, AButtonAsksOnceHoweverLongItIsHeld) {
    Input input;
    set_button(input.gamepad.buttons[static_cast<size_t>(PadButton::kStart)], true);
    set_button(input.gamepad.buttons[static_cast<size_t>(PadButton::kLeftBumper)], true);
    EXPECT_TRUE(read_wishes(input).pause);
    EXPECT_EQ(read_wishes(input).hours, -0.5);
    begin_input_frame(input);
    EXPECT_FALSE(read_wishes(input).pause);
    EXPECT_EQ(read_wishes(input).hours, 0.0);
}

TEST(Wishes, AKeyAsksOnceHoweverLongItIsHeld) {
    Input input;
    set_button(input.keys[static_cast<size_t>(Key::kP)], true);
    set_button(input.keys[static_cast<size_t>(Key::k3)], true);
    EXPECT_TRUE(read_wishes(input).screenshot);
    EXPECT_EQ(read_wishes(input).next_technique, 2u);
    begin_input_frame(input);
    EXPECT_FALSE(read_wishes(input).screenshot);
    EXPECT_FALSE(read_wishes(input).next_technique);
    EXPECT_FALSE(read_wishes(input).quit);
}

}  // namespace
}  // namespace vellus::demo
