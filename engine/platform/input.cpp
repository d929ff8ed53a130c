#include "engine/platform/input.h"

namespace vellus {

namespace {

template <class Function>
void for_each_button(Input& input, Function&& function) {
    for (Button& button : input.keys) function(button);
    for (Button& button : input.mouse) function(button);
    for (Button& button : input.gamepad.buttons) function(button);
}

}  // namespace

void begin_input_frame(Input& input) {
    for_each_button(input, [](Button& button) { button.pressed = button.released = false; });
    input.cursor_dx = input.cursor_dy = 0.0;
    input.scroll_x = input.scroll_y = 0.0;
}

void set_button(Button& button, bool down) {
    if (down == button.held) return;
    button.held = down;
    (down ? button.pressed : button.released) = true;
}

void move_cursor(Input& input, double x, double y) {
    input.cursor_dx += x - input.cursor_x;
    input.cursor_dy += y - input.cursor_y;
    input.cursor_x = x;
    input.cursor_y = y;
}

void release_all(Input& input) {
    for_each_button(input, [](Button& button) { set_button(button, false); });
}

}  // namespace vellus
