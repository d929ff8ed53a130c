#include "game_demo/src/controls.h"

#include <algorithm>
#include <cmath>

namespace vellus::demo {

namespace {

constexpr double kTurnPerHeight = 3.0;  ///< radians for a drag over the window's height
constexpr double kScrollStep = 0.88;    ///< distance after one step of the wheel
constexpr double kMaxPitch = 1.55;      ///< short of the pole, where yaw would jump
constexpr float kStickDeadZone = 0.15f;
constexpr double kStickTurn = 2.0;     ///< radians a second
constexpr double kTriggerSteps = 5.0;  ///< of the wheel, a second

/// From 0 at the edge of the dead zone, so that nothing jumps, to 1.
double stick(float value) {
    const float beyond = (std::abs(value) - kStickDeadZone) / (1.0f - kStickDeadZone);
    return std::copysign(std::clamp(beyond, 0.0f, 1.0f), value);
}

void turn(Orbit& orbit, double right, double down) {
    orbit.yaw = std::remainder(orbit.yaw - right, 2.0 * std::acos(-1.0));
    orbit.pitch = std::clamp(orbit.pitch + down, -kMaxPitch, kMaxPitch);
}

bool steer_by_mouse(Orbit& orbit, const Input& input, double height) {
    const bool moved = input.cursor_dx != 0.0 || input.cursor_dy != 0.0;
    const double right = input.cursor_dx / height;
    const double down = input.cursor_dy / height;
    if (moved && input.button(MouseButton::kLeft).held) {
        turn(orbit, kTurnPerHeight * right, kTurnPerHeight * down);
        return true;
    }
    if (moved &&
        (input.button(MouseButton::kRight).held || input.button(MouseButton::kMiddle).held)) {
        // What was under the pointer stays there.
        const double metres = 2.0 * orbit.distance * std::tan(0.5 * orbit.vertical_fov);
        const glm::dmat3 axes = scene::orbit_axes(orbit.yaw, orbit.pitch);
        orbit.target += metres * (down * axes[1] - right * axes[0]);
        return true;
    }
    return false;
}

}  // namespace

Orbit orbit_from(const scene::CameraPose& pose, const glm::dvec3& center) {
    const glm::dvec3 back = pose.axes[2];
    const double ahead = glm::dot(center - pose.position, -back);
    Orbit orbit;
    orbit.distance = std::max(ahead, 0.05);
    orbit.target = pose.position - back * orbit.distance;
    orbit.yaw = std::atan2(back.x, back.z);
    orbit.pitch = std::clamp(std::asin(std::clamp(back.y, -1.0, 1.0)), -kMaxPitch, kMaxPitch);
    orbit.vertical_fov = pose.vertical_fov;
    return orbit;
}

scene::CameraPose pose_of(const Orbit& orbit) {
    return scene::orbit_pose(orbit.target, orbit.distance, orbit.yaw, orbit.pitch,
                             orbit.vertical_fov);
}

bool steer(Orbit& orbit, const Input& input, double height) {
    bool steered = steer_by_mouse(orbit, input, std::max(height, 1.0));
    double closer = input.scroll_y;
    if (input.gamepad.connected) {
        const double right = stick(input.gamepad.axes[2]);
        const double down = stick(input.gamepad.axes[3]);
        if (right != 0.0 || down != 0.0) {
            const double angle = kStickTurn * input.seconds;
            turn(orbit, angle * right, angle * down);
            steered = true;
        }
        closer += kTriggerSteps * input.seconds *
                  stick(0.5f * (input.gamepad.axes[5] - input.gamepad.axes[4]));
    }
    if (closer != 0.0) {
        orbit.distance = std::clamp(orbit.distance * std::pow(kScrollStep, closer), 1e-3, 1e6);
        steered = true;
    }
    return steered;
}

void look_around(Orbit& orbit, const Input& input, double height) {
    // The camera stays where it is; the point it looks at moves.
    const glm::dvec3 eye = pose_of(orbit).position;
    double right = 0.0;
    double down = 0.0;
    if (input.button(MouseButton::kLeft).held || input.button(MouseButton::kRight).held) {
        right = kTurnPerHeight * input.cursor_dx / std::max(height, 1.0);
        down = kTurnPerHeight * input.cursor_dy / std::max(height, 1.0);
    }
    if (input.gamepad.connected) {
        right += kStickTurn * input.seconds * stick(input.gamepad.axes[2]);
        down += kStickTurn * input.seconds * stick(input.gamepad.axes[3]);
    }
    turn(orbit, right, down);
    orbit.target += eye - pose_of(orbit).position;
}

glm::dvec3 movement(const Input& input) {
    const auto axis = [&](Key less, Key more) {
        return (input.key(more).held ? 1.0 : 0.0) - (input.key(less).held ? 1.0 : 0.0);
    };
    glm::dvec3 wish(axis(Key::kA, Key::kD) + axis(Key::kLeft, Key::kRight), axis(Key::kQ, Key::kE),
                    axis(Key::kW, Key::kS) + axis(Key::kUp, Key::kDown));
    if (input.gamepad.connected) {
        wish.x += stick(input.gamepad.axes[0]);
        wish.z += stick(input.gamepad.axes[1]);
    }
    return glm::clamp(wish, -1.0, 1.0);
}

Wishes read_wishes(const Input& input) {
    const auto pressed = [&](Key key) { return input.key(key).pressed; };
    const auto pad = [&](PadButton button) { return input.gamepad.button(button).pressed; };
    Wishes wishes{.quit = pressed(Key::kEscape),
                  .pause = pressed(Key::kSpace) || pad(PadButton::kStart),
                  .step = pressed(Key::kN) || pad(PadButton::kX),
                  .screenshot = pressed(Key::kF12) || pressed(Key::kP) || pad(PadButton::kY),
                  .help = pressed(Key::kF1) || pressed(Key::kH),
                  .panels = pressed(Key::kTab),
                  .accuracy = pressed(Key::kF2),
                  .taa = pressed(Key::kT),
                  .home = pressed(Key::kHome) || pad(PadButton::kRightThumb),
                  .next_camera = pressed(Key::kC) || pad(PadButton::kBack),
                  .turntable = pressed(Key::kR),
                  .turntable_pictures = pressed(Key::kO),
                  .next_scene = pressed(Key::kF4) || pad(PadButton::kB),
                  .hours = (pressed(Key::kPageUp) || pad(PadButton::kRightBumper) ? 0.5 : 0.0) -
                           (pressed(Key::kPageDown) || pad(PadButton::kLeftBumper) ? 0.5 : 0.0)};
    constexpr std::array kAxisKeys = {Key::k1, Key::k2, Key::k3, Key::k4, Key::k5};
    for (size_t axis = 0; axis < kAxisKeys.size(); ++axis) {
        if (pressed(kAxisKeys[axis])) wishes.next_technique = axis;
    }
    return wishes;
}

const char* controls_help() {
    return "drag            turn            right drag  move           wheel  come closer\n"
           "W A S D, arrows walk, or fly with the free camera (Q E: down, up; Shift: faster)\n"
           "C               next camera     Home        camera of the start\n"
           "Space           pause           N           one step       R      turntable\n"
           "P or F12        screenshot      O           a turn of pictures\n"
           "PageUp PageDown time of day     F4          next scene     T      TAA on or off\n"
           "1 2 3 4 5       next technique for opacity, shadow, scattering, multiple, environment\n"
           "Tab             panels          F2          error against time of every technique\n"
           "H or F1         this help       Esc         end\n"
           "gamepad: left stick walks, right stick turns, triggers come closer; Start pause, X "
           "step,\n"
           "         Y screenshot, Back camera, B scene, bumpers time of day\n";
}

}  // namespace vellus::demo
