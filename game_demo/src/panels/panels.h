#pragma once

#include <memory>

#include "engine/platform/input.h"
#include "engine/platform/window.h"
#include "game_demo/src/panels/panel_pass.h"

struct ImGuiContext;

namespace vellus::demo {

/// Dear ImGui in the demo's window: input in, draw lists out. One at a time.
class Panels {
  public:
    static Result<std::unique_ptr<Panels>> create(gpu::Device& device);
    ~Panels();
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;

    /// Starts a frame; ImGui calls describe panels until end(). `size` in pixels.
    void begin(const Input& input, FramebufferSize size, double seconds);
    void end();
    /// Adds the pass of the frame described last.
    void describe(scene::RenderFrame& frame);

    /// The pointer is over a panel: the mouse is not the camera's.
    [[nodiscard]] bool takes_mouse() const;

  private:
    Panels() = default;

    ImGuiContext* context_ = nullptr;
    std::unique_ptr<PanelPass> pass_;
};

}  // namespace vellus::demo
