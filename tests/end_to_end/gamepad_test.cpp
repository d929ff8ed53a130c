#include <gtest/gtest.h>

#include "engine/platform/window.h"
#include "tests/support/fake_input_devices.h"
#include "tests/support/virtual_display.h"

// What a controller reports becomes Input: the event device, GLFW's mapping and the window between.
namespace vellus {
namespace {

using test::FakeInputDevices;

/// An Xbox 360 controller, which GLFW knows by its id.
FakeInputDevices::Device controller() {
    return {.name = "Microsoft X-Box 360 pad",
            .id = {.bustype = BUS_USB, .vendor = 0x045e, .product = 0x028e, .version = 0x0114},
            .keys = {BTN_A, BTN_B, BTN_X, BTN_Y, BTN_TL, BTN_TR, BTN_SELECT, BTN_START, BTN_MODE,
                     BTN_THUMBL, BTN_THUMBR},
            .axes = {ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_HAT0X, ABS_HAT0Y},
            .range = {.minimum = -1000, .maximum = 1000}};
}

/// A device with an axis that nobody knows as a gamepad, such as a tilt sensor.
FakeInputDevices::Device unknown_joystick() {
    return {.name = "tilt sensor",
            .id = {.bustype = BUS_USB, .vendor = 0x1234, .product = 0x5678, .version = 1},
            .keys = {},
            .axes = {ABS_X, ABS_Y},
            .range = {.minimum = -1000, .maximum = 1000}};
}

class GamepadTest : public testing::Test {
  protected:
    void SetUp() override {
        display_ = test::VirtualDisplay::start();
        if (!display_) GTEST_SKIP() << "Xvfb is not installed";
        ::unsetenv("WAYLAND_DISPLAY");
    }
    void open_window() {
        auto window = Window::create({.title = "gamepad", .width = 64, .height = 64});
        ASSERT_TRUE(window) << window.error().message();
        window_ = std::move(*window);
        window_->poll();
    }
    const Gamepad& pad() { return window_->input().gamepad; }

    std::unique_ptr<test::VirtualDisplay> display_;
    std::unique_ptr<Window> window_;
};

TEST_F(GamepadTest, SticksTriggersAndButtonsComeThrough) {
    FakeInputDevices devices({controller()});
    open_window();
    ASSERT_TRUE(pad().connected);
    EXPECT_FLOAT_EQ(pad().axes[0], 0.0f);

    devices.send(0, EV_ABS, ABS_X, 1000);
    devices.send(0, EV_ABS, ABS_Y, -500);
    devices.send(0, EV_ABS, ABS_RX, 250);
    devices.send(0, EV_ABS, ABS_RZ, 1000);
    devices.send(0, EV_KEY, BTN_START, 1);
    window_->poll();
    EXPECT_FLOAT_EQ(pad().axes[0], 1.0f);
    EXPECT_FLOAT_EQ(pad().axes[1], -0.5f);
    EXPECT_FLOAT_EQ(pad().axes[2], 0.25f);
    EXPECT_FLOAT_EQ(pad().axes[5], 1.0f);
    EXPECT_TRUE(pad().button(PadButton::kStart).pressed);
    EXPECT_FALSE(pad().button(PadButton::kBack).held);

    window_->poll();
    EXPECT_TRUE(pad().button(PadButton::kStart).held);
    EXPECT_FALSE(pad().button(PadButton::kStart).pressed);

    devices.send(0, EV_KEY, BTN_START, 0);
    devices.send(0, EV_ABS, ABS_HAT0X, -1000);
    window_->poll();
    EXPECT_TRUE(pad().button(PadButton::kStart).released);
    EXPECT_TRUE(pad().button(PadButton::kLeft).held);
}

TEST_F(GamepadTest, AnUnknownJoystickBeforeItDoesNotHideIt) {
    FakeInputDevices devices({unknown_joystick(), controller()});
    open_window();
    ASSERT_TRUE(pad().connected);
    devices.send(1, EV_KEY, BTN_A, 1);
    window_->poll();
    EXPECT_TRUE(pad().button(PadButton::kA).pressed);
}

TEST_F(GamepadTest, WithoutOneNothingIsPressed) {
    FakeInputDevices devices({unknown_joystick()});
    open_window();
    EXPECT_FALSE(pad().connected);
    for (const Button& button : pad().buttons) EXPECT_FALSE(button.held);
}

}  // namespace
}  // namespace vellus
