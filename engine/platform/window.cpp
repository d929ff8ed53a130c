#include "engine/platform/window.h"

#include <algorithm>
#include <utility>

// GLFW declares its Vulkan functions only after the Vulkan types.
extern "C" {
#define VK_VERSION_1_0 1
typedef struct VkInstance_T* VkInstance;
typedef struct VkPhysicalDevice_T* VkPhysicalDevice;
typedef struct VkSurfaceKHR_T* VkSurfaceKHR;
typedef struct VkAllocationCallbacks VkAllocationCallbacks;
typedef int VkResult;
}
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace vellus {

namespace {

int g_windows = 0;

/// What GLFW said about the last failure.
std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

Result<void> acquire_glfw() {
    if (g_windows == 0 && glfwInit() != GLFW_TRUE) {
        return Error{"no window system: " + last_glfw_error(), "window",
                     "start it on a desktop, or add --headless"};
    }
    ++g_windows;
    return {};
}

void release_glfw() {
    if (--g_windows == 0) glfwTerminate();
}

constexpr std::pair<int, Key> kNamedKeys[] = {
    {GLFW_KEY_SPACE, Key::kSpace},
    {GLFW_KEY_ENTER, Key::kEnter},
    {GLFW_KEY_KP_ENTER, Key::kEnter},
    {GLFW_KEY_ESCAPE, Key::kEscape},
    {GLFW_KEY_TAB, Key::kTab},
    {GLFW_KEY_BACKSPACE, Key::kBackspace},
    {GLFW_KEY_LEFT, Key::kLeft},
    {GLFW_KEY_RIGHT, Key::kRight},
    {GLFW_KEY_UP, Key::kUp},
    {GLFW_KEY_DOWN, Key::kDown},
    {GLFW_KEY_PAGE_UP, Key::kPageUp},
    {GLFW_KEY_PAGE_DOWN, Key::kPageDown},
    {GLFW_KEY_HOME, Key::kHome},
    {GLFW_KEY_END, Key::kEnd},
    {GLFW_KEY_LEFT_SHIFT, Key::kShift},
    {GLFW_KEY_RIGHT_SHIFT, Key::kShift},
    {GLFW_KEY_LEFT_CONTROL, Key::kControl},
    {GLFW_KEY_RIGHT_CONTROL, Key::kControl},
    {GLFW_KEY_LEFT_ALT, Key::kAlt},
    {GLFW_KEY_RIGHT_ALT, Key::kAlt},
    {GLFW_KEY_MINUS, Key::kMinus},
    {GLFW_KEY_KP_SUBTRACT, Key::kMinus},
    {GLFW_KEY_EQUAL, Key::kEqual},
    {GLFW_KEY_KP_ADD, Key::kEqual},
};

/// The Key of a GLFW code, kCount for keys we do not name.
Key to_key(int code) {
    const auto run = [](Key first, int offset) {
        return static_cast<Key>(static_cast<int>(first) + offset);
    };
    if (code >= GLFW_KEY_A && code <= GLFW_KEY_Z) return run(Key::kA, code - GLFW_KEY_A);
    if (code >= GLFW_KEY_0 && code <= GLFW_KEY_9) return run(Key::k0, code - GLFW_KEY_0);
    if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9) return run(Key::k0, code - GLFW_KEY_KP_0);
    if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12) return run(Key::kF1, code - GLFW_KEY_F1);
    const auto* row = std::ranges::find(kNamedKeys, code, &std::pair<int, Key>::first);
    return row == std::end(kNamedKeys) ? Key::kCount : row->second;
}

Input& input_of(GLFWwindow* window) {
    return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int code, int, int action, int) {
    const Key key = to_key(code);
    if (key == Key::kCount || action == GLFW_REPEAT) return;
    set_button(input_of(window).keys[static_cast<size_t>(key)], action == GLFW_PRESS);
}

void on_mouse_button(GLFWwindow* window, int button, int action, int) {
    if (button >= static_cast<int>(MouseButton::kCount)) return;
    set_button(input_of(window).mouse[static_cast<size_t>(button)], action == GLFW_PRESS);
}

void on_cursor(GLFWwindow* window, double x, double y) {
    move_cursor(input_of(window), x, y);
}

void on_scroll(GLFWwindow* window, double dx, double dy) {
    input_of(window).scroll_x += dx;
    input_of(window).scroll_y += dy;
}

void on_focus(GLFWwindow* window, int focused) {
    if (focused == GLFW_FALSE) release_all(input_of(window));
}

}  // namespace

Result<std::unique_ptr<Window>> Window::create(const WindowOptions& options) {
    if (auto ready = acquire_glfw(); !ready) return ready.error();
    std::unique_ptr<Window> window(new Window);
    if (glfwVulkanSupported() != GLFW_TRUE) {
        return Error{"no Vulkan loader for windows: " + last_glfw_error(), "window",
                     "install libvulkan1 and a driver such as mesa-vulkan-drivers"};
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window->window_ =
        glfwCreateWindow(static_cast<int>(options.width), static_cast<int>(options.height),
                         options.title.c_str(), nullptr, nullptr);
    if (!window->window_) {
        return Error{"cannot open: " + last_glfw_error(), "window", "or add --headless"};
    }
    window->last_size_ = window->framebuffer_size();
    window->install_callbacks();
    return window;
}

bool Window::display_available() {
    if (auto ready = acquire_glfw(); !ready) return false;
    release_glfw();
    return true;
}

Window::~Window() {
    if (window_) glfwDestroyWindow(window_);
    release_glfw();
}

void Window::install_callbacks() {
    glfwSetWindowUserPointer(window_, &input_);
    glfwGetCursorPos(window_, &input_.cursor_x, &input_.cursor_y);
    glfwSetKeyCallback(window_, on_key);
    glfwSetMouseButtonCallback(window_, on_mouse_button);
    glfwSetCursorPosCallback(window_, on_cursor);
    glfwSetScrollCallback(window_, on_scroll);
    glfwSetWindowFocusCallback(window_, on_focus);
}

void Window::poll(double wait_seconds) {
    begin_input_frame(input_);
    if (wait_seconds > 0.0) {
        glfwWaitEventsTimeout(wait_seconds);
    } else {
        glfwPollEvents();
    }
    const FramebufferSize size = framebuffer_size();
    resized_ = size != last_size_;
    last_size_ = size;
    poll_gamepad();
    const double now = glfwGetTime();
    input_.seconds = now - last_poll_;
    last_poll_ = now;
}

void Window::poll_gamepad() {
    GLFWgamepadstate state;
    // Whatever has an axis takes a joystick's place; the first that is a gamepad counts.
    input_.gamepad.connected = false;
    for (int i = GLFW_JOYSTICK_1; i <= GLFW_JOYSTICK_LAST && !input_.gamepad.connected; ++i) {
        input_.gamepad.connected = glfwGetGamepadState(i, &state) == GLFW_TRUE;
    }
    // One that is unplugged lets everything go.
    if (!input_.gamepad.connected) state = {};
    for (size_t i = 0; i < input_.gamepad.buttons.size(); ++i) {
        set_button(input_.gamepad.buttons[i], state.buttons[i] == GLFW_PRESS);
    }
    std::ranges::copy(state.axes, input_.gamepad.axes.begin());
}

FramebufferSize Window::framebuffer_size() const {
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) return {};
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

bool Window::should_close() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::set_size(uint32_t width, uint32_t height) {
    glfwSetWindowSize(window_, static_cast<int>(width), static_cast<int>(height));
}

std::vector<const char*> Window::instance_extensions() const {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

int Window::create_surface(VkInstance_T* instance, VkSurfaceKHR_T** surface) {
    return glfwCreateWindowSurface(instance, window_, nullptr, surface);
}

}  // namespace vellus
