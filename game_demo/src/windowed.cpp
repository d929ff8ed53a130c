#include "game_demo/src/windowed.h"

#include <algorithm>
#include <cstdio>

#include "engine/asset/image_io.h"
#include "engine/gpu/pipeline_library.h"
#include "engine/gpu/swapchain.h"
#include "engine/platform/clock.h"
#include "engine/platform/log.h"
#include "engine/platform/user_folders.h"
#include "engine/platform/window.h"
#include "game_demo/src/content.h"
#include "game_demo/src/explain.h"
#include "game_demo/src/viewer.h"
#include "modules/hair/techniques.h"
#include "modules/scene/time.h"
#include "modules/temporal/temporal.h"

namespace vellus::demo {

namespace {

constexpr double kTitleSeconds = 0.5;
constexpr double kHiddenWait = 0.1;  ///< seconds between looks at a minimised window

/// Writes the first screenshot_NNNN.png that does not exist yet.
Result<void> save_screenshot(const std::filesystem::path& folder, const asset::Image& image) {
    for (int number = 0;; ++number) {
        const auto file = folder / fmt::format("screenshot_{:04}.png", number);
        std::error_code code;
        if (std::filesystem::exists(file, code)) continue;
        if (auto saved = asset::save_png(file, image); !saved) return saved;
        log_info("saved {}", file.string());
        return {};
    }
}

/// The axis' next technique, for every groom.
void next_technique(World& world, size_t axis_index) {
    const std::string_view axis = hair::axes()[axis_index];
    const auto ids = hair::technique_ids(axis);
    std::string_view chosen;
    world.query<hair::HairTechniques>().each([&](hair::HairTechniques& techniques) {
        if (chosen.empty()) {
            const auto now = std::ranges::find(ids, hair::technique_id(techniques, axis));
            chosen = ids[static_cast<size_t>(now - ids.begin() + 1) % ids.size()];
        }
        static_cast<void>(hair::set_technique(techniques, axis, chosen));
    });
    if (!chosen.empty()) log_info("{}={}", axis, chosen);
}

/// The demo while its window is open.
class Session {
  public:
    Session(Window& window, gpu::Device& device, const Options& options)
        : window_(window), device_(device), options_(options) {}

    Result<void> run() {
        const FramebufferSize size = window_.framebuffer_size();
        auto swapchain = gpu::Swapchain::create(device_, size.width, size.height);
        if (!swapchain) return swapchain.error();
        swapchain_ = std::move(*swapchain);
        auto renderer = Renderer::create(device_, options_.switches);
        if (!renderer) return renderer.error();
        renderer_ = std::move(*renderer);
        if (auto loaded = load_content(*renderer_, device_, options_); !loaded) return loaded;
        viewer_.emplace(renderer_->world());
        fmt::print("{}", controls_help());
        std::fflush(stdout);
        while (!window_.should_close()) {
            if (auto done = frame(); !done) return done;
        }
        if (auto done = renderer_->wait(); !done) return done;
        if (options_.explain) print_explanation(*renderer_);
        return {};
    }

  private:
    Result<void> frame() {
        window_.poll(hidden_ ? kHiddenWait : 0.0);
        const FramebufferSize size = window_.framebuffer_size();
        swapchain_->resize(size.width, size.height);
        const Wishes wishes = read_wishes(window_.input());
        obey(wishes);
        hidden_ = size.empty();
        if (hidden_) return {};
        renderer_->resize(size.width, size.height);
        viewer_->update(window_.input(), size.height);
        reload_shaders();

        auto& step = renderer_->world().resource<scene::FixedStep>();
        step.dt = paused_ && !wishes.step ? 0.0 : options_.dt;
        if (wishes.screenshot) {
            if (auto saved = screenshot(); !saved) return saved;
        }
        if (auto drawn = renderer_->draw(Output::kPicture); !drawn) return drawn;
        const gpu::Image& picture = renderer_->picture();
        auto shown =
            swapchain_->present(picture.handle(), picture.info().width, picture.info().height);
        if (!shown) return shown.error();
        hidden_ = *shown == gpu::Presented::kHidden;
        count_frame();
        return {};
    }

    void obey(const Wishes& wishes) {
        if (wishes.quit) window_.close();
        if (wishes.pause) paused_ = !paused_;
        if (wishes.step) paused_ = true;
        if (wishes.help) fmt::print("{}", controls_help());
        if (wishes.home) viewer_->go_home();
        if (wishes.taa) {
            auto& taa = renderer_->world().resource<temporal::TemporalSettings>();
            taa.enabled = !taa.enabled;
            log_info("TAA {}", taa.enabled ? "on" : "off");
        }
        if (wishes.next_technique) next_technique(renderer_->world(), *wishes.next_technique);
        std::fflush(stdout);
    }

    /// An extra frame to the CPU; a picture that cannot be written is no reason to end.
    Result<void> screenshot() {
        if (auto drawn = renderer_->draw(Output::kPixels); !drawn) return drawn;
        if (auto done = renderer_->wait(); !done) return done;
        if (auto saved = save_screenshot(options_.out, renderer_->pixels()); !saved) {
            log_error("{}", saved.error().message());
        }
        return {};
    }

    void reload_shaders() {
#ifndef NDEBUG
        if (wall_seconds() < next_reload_) return;
        next_reload_ = wall_seconds() + 0.5;
        // A shader that does not compile was reported; the old one goes on.
        static_cast<void>(device_.pipelines().reload_changed());
#endif
    }

    void count_frame() {
        ++frames_;
        if (options_.frames != 0 && frames_ == options_.frames) window_.close();
        const double now = wall_seconds();
        if (now - title_time_ < kTitleSeconds) return;
        const double frame_seconds = (now - title_time_) / (frames_ - title_frames_);
        if (title_frames_ > 0) {
            window_.set_title(fmt::format("Vellus: {:.1f} fps, {:.1f} ms{} (H: help)",
                                          1.0 / frame_seconds, 1e3 * frame_seconds,
                                          paused_ ? ", paused" : ""));
        }
        title_time_ = now;
        title_frames_ = frames_;
    }

    Window& window_;
    gpu::Device& device_;
    const Options& options_;
    std::unique_ptr<gpu::Swapchain> swapchain_;
    std::unique_ptr<Renderer> renderer_;
    std::optional<Viewer> viewer_;
    bool hidden_ = false;
    bool paused_ = false;
    uint32_t frames_ = 0;
    uint32_t title_frames_ = 0;
    double title_time_ = 0.0;
    [[maybe_unused]] double next_reload_ = 0.0;
};

}  // namespace

Result<uint32_t> run_windowed(const Options& options) {
    auto window =
        Window::create({.title = "Vellus", .width = options.size[0], .height = options.size[1]});
    if (!window) return window.error();
    auto device = gpu::Device::create(
        {.name = options.device,
         .validation = options.validation,
         .pipeline_cache_folder = cache_folder(),
         .instance_extensions = (*window)->instance_extensions(),
         .create_surface = [&](VkInstance instance, VkSurfaceKHR* surface) {
             return static_cast<VkResult>((*window)->create_surface(instance, surface));
         }});
    if (!device) return device.error();
    {
        Session session(**window, **device, options);
        if (auto done = session.run(); !done) return done.error();
    }
    return (*device)->validation_messages();
}

}  // namespace vellus::demo
