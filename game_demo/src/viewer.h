#pragma once

#include <optional>

#include "engine/ecs/ecs.h"
#include "game_demo/src/controls.h"

namespace vellus::demo {

/// Who moves the camera.
enum class CameraMode : uint8_t {
    kScene,   ///< the scene
    kOrbit,   ///< the user, around a point
    kFree,    ///< the user, flying
    kFollow,  ///< the user, around the player
};
const char* text(CameraMode mode);

/// The user's camera: takes over from the scene's at the first move, gives back on Home.
class Viewer {
  public:
    explicit Viewer(World& world);

    /// Once a frame, before it is drawn. `input` is null while panels have the mouse; `height` of
    /// the window in screen coordinates; `player`: where it stands, if there is one.
    void update(const Input* input, double height, double seconds,
                const std::optional<glm::dvec3>& player);
    /// From where the camera is now; kScene gives it back to the scene.
    void set_mode(CameraMode mode);
    [[nodiscard]] CameraMode mode() const { return mode_; }
    /// Turns the orbit, radians counter-clockwise from above.
    void turn(double radians);
    /// Which way is ahead for someone looking through the camera: radians about +Y, 0 is -Z.
    [[nodiscard]] double yaw() const;

  private:
    void take_over();
    void fly(const Input& input, double height, double seconds);
    void place();

    World& world_;
    Entity scene_camera_ = kNoEntity;
    Entity own_camera_ = kNoEntity;
    CameraMode mode_ = CameraMode::kScene;
    Orbit orbit_;
    double fly_speed_ = 1.5;  ///< metres a second
};

}  // namespace vellus::demo
