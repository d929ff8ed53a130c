#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vellus {

/// Keys by their place on a US keyboard.
enum class Key : uint8_t {
    // clang-format off
    kA, kB, kC, kD, kE, kF, kG, kH, kI, kJ, kK, kL, kM,
    kN, kO, kP, kQ, kR, kS, kT, kU, kV, kW, kX, kY, kZ,
    k0, k1, k2, k3, k4, k5, k6, k7, k8, k9,
    kF1, kF2, kF3, kF4, kF5, kF6, kF7, kF8, kF9, kF10, kF11, kF12,
    kSpace, kEnter, kEscape, kTab, kBackspace, kLeft, kRight, kUp, kDown,
    kPageUp, kPageDown, kHome, kEnd, kShift, kControl, kAlt, kMinus, kEqual,
    // clang-format on
    kCount,
};

enum class MouseButton : uint8_t { kLeft, kRight, kMiddle, kCount };

/// One button during one frame; pressed and released are edges within that frame.
struct Button {
    bool held = false;
    bool pressed = false;
    bool released = false;
};

/// Buttons of a gamepad in the layout of an Xbox controller, in GLFW's order.
enum class PadButton : uint8_t {
    kA,
    kB,
    kX,
    kY,
    kLeftBumper,
    kRightBumper,
    kBack,
    kStart,
    kGuide,
    kLeftThumb,
    kRightThumb,
    kUp,
    kRight,
    kDown,
    kLeft,
    kCount,
};

/// The first connected gamepad.
struct Gamepad {
    bool connected = false;
    std::array<Button, static_cast<size_t>(PadButton::kCount)> buttons{};
    std::array<float, 6> axes{};  ///< left x, y, right x, y in [-1, 1]; triggers, -1 at rest

    [[nodiscard]] const Button& button(PadButton button) const {
        return buttons[static_cast<size_t>(button)];
    }
};

/// Everything the user did between two polls; positions in window coordinates, y down.
struct Input {
    std::array<Button, static_cast<size_t>(Key::kCount)> keys{};
    std::array<Button, static_cast<size_t>(MouseButton::kCount)> mouse{};
    double cursor_x = 0.0, cursor_y = 0.0;
    double cursor_dx = 0.0, cursor_dy = 0.0;
    double scroll_x = 0.0, scroll_y = 0.0;  ///< wheel steps, up is positive
    Gamepad gamepad;
    double seconds = 0.0;  ///< since the poll before

    [[nodiscard]] const Button& key(Key key) const { return keys[static_cast<size_t>(key)]; }
    [[nodiscard]] const Button& button(MouseButton button) const {
        return mouse[static_cast<size_t>(button)];
    }
};

/// Forgets the edges and movements of the last frame; what is held stays held.
void begin_input_frame(Input& input);
/// A button went down or up. Both within one frame leave both edges set.
void set_button(Button& button, bool down);
/// The pointer is now at (x, y); movement adds up within a frame.
void move_cursor(Input& input, double x, double y);
/// Nothing is held any more, as when the window loses the keyboard.
void release_all(Input& input);

}  // namespace vellus
