#include "engine/platform/input.h"

#include <gtest/gtest.h>

namespace vellus {
namespace {

Button& space(Input& input) {
    return input.keys[static_cast<size_t>(Key::kSpace)];
}

TEST(Input, EdgesLastOneFrameAndHoldingLasts) {
    Input input;
    set_button(space(input), true);
    EXPECT_TRUE(input.key(Key::kSpace).pressed && input.key(Key::kSpace).held);
    begin_input_frame(input);
    EXPECT_TRUE(input.key(Key::kSpace).held);
    EXPECT_FALSE(input.key(Key::kSpace).pressed);
    set_button(space(input), false);
    EXPECT_TRUE(input.key(Key::kSpace).released);
    EXPECT_FALSE(input.key(Key::kSpace).held);
    begin_input_frame(input);
    EXPECT_FALSE(input.key(Key::kSpace).released);
}

TEST(Input, ATapWithinOneFrameIsNotLost) {
    Input input;
    set_button(space(input), true);
    set_button(space(input), false);
    EXPECT_TRUE(input.key(Key::kSpace).pressed);
    EXPECT_TRUE(input.key(Key::kSpace).released);
    EXPECT_FALSE(input.key(Key::kSpace).held);
}

TEST(Input, CursorMovementAddsUpWithinAFrame) {
    Input input;
    move_cursor(input, 10.0, 5.0);
    begin_input_frame(input);
    move_cursor(input, 12.0, 4.0);
    move_cursor(input, 15.0, 8.0);
    EXPECT_DOUBLE_EQ(input.cursor_dx, 5.0);
    EXPECT_DOUBLE_EQ(input.cursor_dy, 3.0);
    EXPECT_DOUBLE_EQ(input.cursor_x, 15.0);
}

TEST(Input, LosingTheKeyboardReleasesEverything) {
    Input input;
    set_button(space(input), true);
    set_button(input.mouse[0], true);
    begin_input_frame(input);
    release_all(input);
    EXPECT_TRUE(input.key(Key::kSpace).released);
    EXPECT_FALSE(input.key(Key::kSpace).held);
    EXPECT_FALSE(input.button(MouseButton::kLeft).held);
    EXPECT_FALSE(input.key(Key::kA).released) << "was never held";
}

}  // namespace
}  // namespace vellus
