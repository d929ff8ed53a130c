#pragma once

#include <array>
#include <optional>

#include "engine/platform/input.h"
#include "modules/scene/camera.h"

namespace vellus::demo {

/// A camera that turns around a point.
struct Orbit {
    glm::dvec3 target{0.0};
    double distance = 1.0;  ///< metres
    double yaw = 0.0;
    double pitch = 0.0;
    float vertical_fov = 0.6f;
};

/// The orbit that shows what `pose` shows, around the point of its view axis nearest to `center`.
Orbit orbit_from(const scene::CameraPose& pose, const glm::dvec3& center);
scene::CameraPose pose_of(const Orbit& orbit);
/// Drag turns, right or middle drag moves, the wheel comes closer, so do a gamepad's sticks and
/// triggers, by the seconds of `input`; `height` of the window in screen coordinates. False where
/// nothing changed.
bool steer(Orbit& orbit, const Input& input, double height);
/// Drag and right stick turn the view about the camera itself.
void look_around(Orbit& orbit, const Input& input, double height);
/// W A S D or arrows, Q and E, left stick: right, up and back, each in [-1, 1].
glm::dvec3 movement(const Input& input);

/// What the keys pressed in this frame ask for.
struct Wishes {
    bool quit = false;
    bool pause = false;
    bool step = false;
    bool screenshot = false;
    bool help = false;
    bool panels = false;
    bool accuracy = false;
    bool taa = false;
    bool home = false;
    bool next_camera = false;
    bool turntable = false;           ///< on or off
    bool turntable_pictures = false;  ///< one turn into files
    bool next_scene = false;
    double hours = 0.0;                    ///< to move the time of day by
    std::optional<size_t> next_technique;  ///< index of an axis
};
Wishes read_wishes(const Input& input);

/// The keys and what they do, a line each.
const char* controls_help();

}  // namespace vellus::demo
