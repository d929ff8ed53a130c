#pragma once

#include "engine/gpu/device.h"
#include "game_demo/src/renderer.h"

namespace vellus::demo {

/// Time of day of a scene under the default sky: turns its sun and paints the sky anew.
class Daylight {
  public:
    /// Takes the strongest directional light for the sun.
    explicit Daylight(World& world);

    [[nodiscard]] double hour() const { return hour_; }
    /// Waits for the frames in flight, which still use the old sky; 20 ms of CPU time.
    Result<void> set_hour(double hour, Renderer& renderer, gpu::Device& device);

  private:
    Entity sun_ = kNoEntity;
    double hour_ = 10.0;
};

}  // namespace vellus::demo
