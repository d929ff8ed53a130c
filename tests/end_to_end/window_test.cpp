#include <gtest/gtest.h>

#include <algorithm>

#include "engine/asset/image_io.h"
#include "tests/end_to_end/demo_process.h"
#include "tests/end_to_end/small_groom.h"
#include "tests/support/own_folder.h"
#include "tests/support/virtual_display.h"

namespace vellus::test {
namespace {

namespace fs = std::filesystem;

/// The demo in a window on a screen of its own, driven by xdotool.
class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        display_ = VirtualDisplay::start();
        if (!display_) GTEST_SKIP() << "Xvfb is not installed";
        if (run({"xdotool", "version"}).status != 0) GTEST_SKIP() << "xdotool is not installed";
        ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
        ::unsetenv("WAYLAND_DISPLAY");
        groom_ = write_small_groom(folder_);
    }

    std::vector<std::string> in_window() const {
        return demo({groom_, "--validation", "--size", "320x240", "--out", folder_ / "pictures"});
    }
    static void xdotool(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "xdotool");
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.status, 0) << arguments[1] << ": " << ended.output;
    }
    /// The window's id once it is on the screen, with the keyboard.
    static std::string find_window() {
        std::string id =
            run({"xdotool", "search", "--sync", "--onlyvisible", "--name", "Vellus"}).output;
        id = id.substr(0, id.find('\n'));
        xdotool({"windowfocus", "--sync", id});
        return id;
    }

    std::unique_ptr<VirtualDisplay> display_;
    OwnFolder own_folder_{"window"};
    fs::path folder_ = own_folder_.path();
    fs::path groom_;
};

/// Whether something brighter than black was drawn, and more than one colour.
bool shows_something(const asset::Image& image) {
    const auto [low, high] = std::ranges::minmax(image.rgba);
    bool varied = false;
    for (size_t i = 4; i < image.rgba.size(); ++i) varied |= image.rgba[i] != image.rgba[i - 4];
    return varied && high > 32 && low < high;
}

TEST_F(WindowTest, ResizesTakesAScreenshotAndClosesByKey) {
    Process demo(in_window());
    ASSERT_TRUE(demo.wait_for("Esc")) << "prints its keys once it is ready: " << demo.output();
    const std::string id = find_window();
    xdotool({"key", "P"});
    ASSERT_TRUE(demo.wait_for("screenshot_0000.png")) << demo.output();
    xdotool({"windowsize", "--sync", id, "500", "400"});
    xdotool({"key", "F12"});
    ASSERT_TRUE(demo.wait_for("screenshot_0001.png")) << demo.output();
    EXPECT_NE(display_->pixel(250, 20), 0u) << "the sky is on the screen";
    xdotool({"key", "t"});
    ASSERT_TRUE(demo.wait_for("TAA off")) << demo.output();
    xdotool({"key", "2"});
    ASSERT_TRUE(demo.wait_for("shadow=none")) << demo.output();
    // Turning the camera and shrinking the window in between must not upset anything.
    xdotool({"mousemove", "--window", id, "200", "200", "mousedown", "1"});
    xdotool({"mousemove_relative", "60", "20", "mouseup", "1", "click", "4", "key", "space"});
    xdotool({"windowsize", "--sync", id, "130", "70"});
    xdotool({"key", "P"});
    ASSERT_TRUE(demo.wait_for("screenshot_0002.png")) << demo.output();
    xdotool({"key", "Escape"});
    EXPECT_EQ(demo.wait(), 0) << "no validation message, no error: " << demo.output();

    const std::array<std::array<uint32_t, 2>, 3> sizes = {{{320, 240}, {500, 400}, {130, 70}}};
    for (size_t i = 0; i < sizes.size(); ++i) {
        const auto file = folder_ / "pictures" / ("screenshot_000" + std::to_string(i) + ".png");
        const auto image = asset::load_image(file);
        ASSERT_TRUE(image) << image.error().message();
        EXPECT_EQ(image->width, sizes[i][0]);
        EXPECT_EQ(image->height, sizes[i][1]);
        EXPECT_TRUE(shows_something(*image)) << file;
    }
}

/// Every key once, panels and mouse, and another scene: what a curious visitor does.
TEST_F(WindowTest, PlaysThroughEverySwitch) {
    Process demo(in_window());
    ASSERT_TRUE(demo.wait_for("Esc")) << demo.output();
    const std::string id = find_window();
    xdotool({"windowsize", "--sync", id, "400", "300"});
    xdotool({"key", "Tab"});
    const auto press = [&](const char* key, const char* says) {
        xdotool({"key", key});
        EXPECT_TRUE(demo.wait_for(says)) << key << ": " << demo.output();
    };
    press("c", "camera=orbit");
    press("c", "camera=free");
    xdotool({"keydown", "w"});
    press("r", "turntable on");
    xdotool({"keyup", "w"});
    press("r", "turntable off");
    press("Next", "time of day 9.5");
    press("Prior", "time of day 10.0");
    press("t", "TAA off");
    press("1", "opacity=dither_still");
    press("2", "shadow=none");
    press("4", "multiple=");
    press("5", "environment=");
    press("3", "scattering=");
    xdotool({"key", "F1", "space", "n", "Home"});
    // Over the panel the mouse is the panel's: a drag along its slider must upset nothing.
    xdotool({"mousemove", "--window", id, "120", "120", "mousedown", "1"});
    xdotool({"mousemove_relative", "40", "60", "mouseup", "1", "click", "4", "click", "5"});
    press("o", "turntable_0023.png");
    press("F4", "scene ");
    press("p", "screenshot_0000.png");
    xdotool({"key", "Escape"});
    EXPECT_EQ(demo.wait(), 0) << "no validation message, no error: " << demo.output();
}

TEST_F(WindowTest, ClosesAfterTheFramesAskedFor) {
    auto arguments = in_window();
    arguments.insert(arguments.end(), {"--frames", "5", "--explain"});
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_NE(ended.output.find("demo/picture"), std::string::npos) << ended.output;
}

TEST_F(WindowTest, WithoutADisplaySaysSo) {
    ::setenv("DISPLAY", ":unused", 1);
    const Ended ended = run(in_window());
    EXPECT_EQ(ended.status, 1);
    EXPECT_NE(ended.output.find("--headless"), std::string::npos) << ended.output;
}

}  // namespace
}  // namespace vellus::test
