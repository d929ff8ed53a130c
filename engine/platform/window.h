#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/platform/input.h"
#include "engine/platform/result.h"

struct GLFWwindow;
struct VkInstance_T;
struct VkSurfaceKHR_T;

namespace vellus {

struct WindowOptions {
    std::string title = "Vellus";
    uint32_t width = 1280;  ///< client area, in screen coordinates
    uint32_t height = 720;
};

/// Size of the framebuffer in pixels; 0x0 while minimised.
struct FramebufferSize {
    uint32_t width = 0;
    uint32_t height = 0;
    bool operator==(const FramebufferSize&) const = default;
    [[nodiscard]] bool empty() const { return width == 0 || height == 0; }
};

/// A window of the desktop, its events and its surface for Vulkan. Main thread only.
class Window {
  public:
    /// Errors say that there is no display, or what the window system refused.
    static Result<std::unique_ptr<Window>> create(const WindowOptions& options);
    /// True where a window can be opened at all.
    static bool display_available();
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Starts a new frame of input and takes in all waiting events; `wait_seconds` > 0 sleeps until
    /// one comes or the time is over.
    void poll(double wait_seconds = 0.0);
    [[nodiscard]] const Input& input() const { return input_; }
    [[nodiscard]] FramebufferSize framebuffer_size() const;
    /// The last poll() found the framebuffer's size changed.
    [[nodiscard]] bool resized() const { return resized_; }
    /// The user, or close(), asked for the end.
    [[nodiscard]] bool should_close() const;
    void close();
    void set_title(const std::string& title);
    /// Asks the window system for another client area; resized() tells when it has happened.
    void set_size(uint32_t width, uint32_t height);

    /// What gpu::DeviceOptions needs; the surface's result is a VkResult.
    [[nodiscard]] std::vector<const char*> instance_extensions() const;
    int create_surface(VkInstance_T* instance, VkSurfaceKHR_T** surface);

  private:
    Window() = default;
    void install_callbacks();
    void poll_gamepad();

    GLFWwindow* window_ = nullptr;
    Input input_;
    double last_poll_ = 0.0;
    FramebufferSize last_size_;
    bool resized_ = false;
};

}  // namespace vellus
