#pragma once

#include <memory>

#include "engine/gpu/swapchain.h"
#include "engine/platform/window.h"
#include "game_demo/src/daylight.h"
#include "game_demo/src/demo_state.h"
#include "game_demo/src/options.h"
#include "game_demo/src/panels/accuracy_panel.h"
#include "game_demo/src/panels/panels.h"
#include "game_demo/src/player.h"
#include "game_demo/src/renderer.h"

namespace vellus::demo {

/// One scene as the user sees it: everything that goes when another is opened.
struct OpenScene {
    std::unique_ptr<Renderer> renderer;
    std::unique_ptr<Viewer> viewer;
    std::unique_ptr<Player> player;      ///< null: nobody to walk
    std::unique_ptr<Daylight> daylight;  ///< null: the scene has an environment of its own
};
Result<OpenScene> open_scene(gpu::Device& device, const Options& options, FramebufferSize size);

/// The demo while its window is open.
class Session {
  public:
    Session(Window& window, gpu::Device& device, const Options& options)
        : window_(window), device_(device), options_(options) {}
    /// Until the window is closed or `options.frames` are drawn.
    Result<void> run();

  private:
    Result<void> start();
    Result<void> frame();
    void obey(const Wishes& wishes);
    Result<void> apply_state();
    void describe_panels();
    Result<void> show();
    Result<void> screenshot(const std::string& stem);
    Result<void> turntable_picture();
    void switch_scene(size_t index);
    Result<void> open_accuracy();
    Result<void> keep_to_budget();
    void reload_shaders();
    void count_frame();
    World& world() { return scene_.renderer->world(); }

    Window& window_;
    gpu::Device& device_;
    Options options_;
    std::unique_ptr<gpu::Swapchain> swapchain_;
    std::unique_ptr<Panels> panels_;
    OpenScene scene_;
    DemoState state_;
    std::optional<AccuracyPanel> accuracy_;
    FrameWatch watch_;  ///< of the open scene, where there is a budget
    FrameTimes times_;
    double frame_start_ = 0.0;
    double frame_seconds_ = 0.0;
    bool hidden_ = false;
    uint32_t pictures_left_ = 0;  ///< of a turn into files
    uint32_t frames_ = 0;
    uint32_t title_frames_ = 0;
    double title_time_ = 0.0;
    [[maybe_unused]] double next_reload_ = 0.0;
};

}  // namespace vellus::demo
