#include "engine/gpu/swapchain.h"

#include <gtest/gtest.h>

#include <functional>

#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"
#include "engine/platform/window.h"
#include "tests/support/virtual_display.h"

namespace vellus::gpu {
namespace {

/// A window on a screen of its own, a device that presents to it, and a picture to show.
class SwapchainTest : public testing::Test {
  protected:
    void SetUp() override {
        display_ = test::VirtualDisplay::start();
        if (!display_) GTEST_SKIP() << "Xvfb is not installed";
        open_window(300, 200);
        auto device = Device::create(
            {.validation = true,
             .instance_extensions = window_->instance_extensions(),
             .create_surface = [this](VkInstance instance, VkSurfaceKHR* surface) {
                 return static_cast<VkResult>(window_->create_surface(instance, surface));
             }});
        ASSERT_TRUE(device) << device.error().message();
        device_ = std::move(*device);
        auto swapchain = Swapchain::create(*device_, 300, 200);
        ASSERT_TRUE(swapchain) << swapchain.error().message();
        swapchain_ = std::move(*swapchain);
    }
    void TearDown() override {
        if (device_) {
            EXPECT_EQ(device_->validation_messages(), 0u);
        }
    }

    void open_window(uint32_t width, uint32_t height) {
        auto window = Window::create({.title = "swapchain", .width = width, .height = height});
        ASSERT_TRUE(window) << window.error().message();
        window_ = std::move(*window);
    }

    /// Shows one colour in a picture of the given size.
    Result<Presented> show(uint32_t rgb, uint32_t width, uint32_t height) {
        const uint32_t rgba = 0xff000000u | (rgb & 0xffu) << 16u | (rgb & 0xff00u) | rgb >> 16u;
        const std::vector<uint32_t> pixels(size_t{width} * height, rgba);
        auto image = Image::upload(*device_, {.width = width, .height = height},
                                   std::as_bytes(std::span(pixels)), "picture");
        if (!image) return image.error();
        auto ready = device_->submit_now("picture", [&](VkCommandBuffer commands) {
            transition(commands, image->handle(), Format::kRgba8Unorm,
                       VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        });
        if (!ready) return ready.error();
        auto presented = swapchain_->present(image->handle(), width, height);
        if (auto idle = device_->wait_idle(); !idle) return idle.error();
        window_->poll();
        return presented;
    }

    /// Shows a colour until the middle of the screen's window area has it; the X server works on
    /// its own time. False after many tries.
    bool reaches_the_screen(uint32_t rgb, uint32_t width, uint32_t height) {
        for (int i = 0; i < 500; ++i) {
            const auto presented = show(rgb, width, height);
            if (!presented) ADD_FAILURE() << presented.error().message();
            if (!presented) return false;
            if (display_->pixel(width / 2, height / 2) == rgb) return true;
        }
        return false;
    }

    std::unique_ptr<test::VirtualDisplay> display_;
    std::unique_ptr<Window> window_;
    std::unique_ptr<Device> device_;
    std::unique_ptr<Swapchain> swapchain_;
};

TEST_F(SwapchainTest, PixelsReachTheScreenUnchanged) {
    // Mid values would move if they were sRGB-encoded a second time, or red and blue swapped.
    EXPECT_TRUE(reaches_the_screen(0x804020, 300, 200));
    EXPECT_TRUE(reaches_the_screen(0x0bc55e, 300, 200));
}

TEST_F(SwapchainTest, FollowsTheWindowsSize) {
    ASSERT_TRUE(reaches_the_screen(0x112233, 300, 200));
    const uint32_t before = swapchain_->generation();
    window_->set_size(500, 400);
    for (int i = 0; i < 500 && !window_->resized(); ++i) window_->poll(0.01);
    EXPECT_EQ(window_->framebuffer_size(), (FramebufferSize{500, 400}));
    swapchain_->resize(500, 400);
    EXPECT_TRUE(reaches_the_screen(0x445566, 500, 400));
    EXPECT_EQ(swapchain_->width(), 500u);
    EXPECT_EQ(swapchain_->height(), 400u);
    EXPECT_GT(swapchain_->generation(), before);
}

TEST_F(SwapchainTest, NoticesANewSizeWithoutBeingTold) {
    ASSERT_TRUE(reaches_the_screen(0x112233, 300, 200));
    window_->set_size(420, 240);
    for (int i = 0; i < 500 && swapchain_->width() != 420; ++i) ASSERT_TRUE(show(0x1, 420, 240));
    EXPECT_EQ(swapchain_->width(), 420u);
    EXPECT_TRUE(reaches_the_screen(0x778899, 420, 240));
}

TEST_F(SwapchainTest, AMinimisedWindowShowsNothingAndComesBack) {
    swapchain_->resize(0, 0);
    const auto hidden = show(0xffffff, 300, 200);
    ASSERT_TRUE(hidden);
    EXPECT_EQ(*hidden, Presented::kHidden);
    swapchain_->resize(300, 200);
    EXPECT_TRUE(reaches_the_screen(0xabcdef, 300, 200));
}

TEST_F(SwapchainTest, ALostSurfaceIsReplaced) {
    ASSERT_TRUE(reaches_the_screen(0x112233, 300, 200));
    open_window(320, 240);  // and closes the first
    swapchain_->resize(320, 240);
    EXPECT_TRUE(reaches_the_screen(0x336699, 320, 240));
    EXPECT_EQ(swapchain_->width(), 320u);
}

}  // namespace
}  // namespace vellus::gpu
