#pragma once

#include "engine/ecs/ecs.h"
#include "game_demo/src/controls.h"

namespace vellus::demo {

/// The user's camera: takes over from the scene's at the first move, gives back on Home.
class Viewer {
  public:
    explicit Viewer(World& world);

    /// Once a frame, before it is drawn; `height` of the window in screen coordinates.
    void update(const Input& input, double height);
    /// Back to the scene's camera.
    void go_home();

  private:
    void take_over();

    World& world_;
    Entity scene_camera_ = kNoEntity;
    Entity own_camera_ = kNoEntity;
    Orbit orbit_;
};

}  // namespace vellus::demo
