#include "game_demo/src/session.h"

#include <algorithm>
#include <cstdio>

#include "engine/asset/image_io.h"
#include "engine/gpu/pipeline_library.h"
#include "engine/platform/clock.h"
#include "engine/platform/log.h"
#include "game_demo/src/content.h"
#include "game_demo/src/explain.h"
#include "game_demo/src/panels/main_panel.h"
#include "modules/hair/techniques.h"
#include "modules/scene/time.h"
#include "modules/temporal/temporal.h"

namespace vellus::demo {

namespace {

constexpr double kTitleSeconds = 0.5;
constexpr double kHiddenWait = 0.1;   ///< seconds between looks at a minimised window
constexpr double kLongestStep = 0.1;  ///< a frame that took longer does not move anything further
constexpr double kTurntableSpeed = 0.6;  ///< radians a second
constexpr uint32_t kTurntablePictures = 24;
constexpr uint32_t kSettleFrames = 8;  ///< after which the history has forgotten the last view

/// Writes the first STEM_NNNN.png that does not exist yet.
Result<void> save_numbered(const std::filesystem::path& folder, const std::string& stem,
                           const asset::Image& image) {
    for (int number = 0;; ++number) {
        const auto file = folder / fmt::format("{}_{:04}.png", stem, number);
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

/// The scenes that came with the program, and the one asked for.
std::vector<std::filesystem::path> known_scenes(const Options& options) {
    std::vector<std::filesystem::path> scenes;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(scene_folder(), code)) {
        if (entry.path().extension() == ".gltf") scenes.push_back(entry.path());
    }
    std::ranges::sort(scenes);
    const auto open = content_path(options);
    const auto same = [&](const std::filesystem::path& path) {
        return std::filesystem::equivalent(path, open, code);
    };
    if (std::ranges::none_of(scenes, same)) scenes.insert(scenes.begin(), open);
    return scenes;
}

}  // namespace

Result<OpenScene> open_scene(gpu::Device& device, const Options& options, FramebufferSize size) {
    OpenScene scene;
    auto renderer = Renderer::create(device, options.switches);
    if (!renderer) return renderer.error();
    scene.renderer = std::move(*renderer);
    auto loaded = load_content(*scene.renderer, options);
    if (!loaded) return loaded.error();
    if (!size.empty()) scene.renderer->resize(size.width, size.height);
    World& world = scene.renderer->world();
    scene.viewer = std::make_unique<Viewer>(world);
    auto player = Player::find(world);
    if (!player) return player.error();
    scene.player = std::move(*player);
    if (loaded->default_sky) scene.daylight = std::make_unique<Daylight>(world);
    return scene;
}

Result<void> Session::start() {
    const FramebufferSize size = window_.framebuffer_size();
    auto swapchain = gpu::Swapchain::create(device_, size.width, size.height);
    if (!swapchain) return swapchain.error();
    swapchain_ = std::move(*swapchain);
    auto scene = open_scene(device_, options_, size);
    if (!scene) return scene.error();
    scene_ = std::move(*scene);
    state_.scenes = known_scenes(options_);
    const auto open = std::ranges::find_if(state_.scenes, [&](const auto& path) {
        std::error_code code;
        return std::filesystem::equivalent(path, content_path(options_), code);
    });
    state_.scene = static_cast<size_t>(open - state_.scenes.begin()) % state_.scenes.size();
    fmt::print("{}", controls_help());
    std::fflush(stdout);
    return options_.budget_ms ? open_accuracy() : Result<void>{};
}

Result<void> Session::run() {
    if (auto started = start(); !started) return started;
    frame_start_ = wall_seconds();
    while (!window_.should_close()) {
        if (auto done = frame(); !done) return done;
    }
    if (auto done = scene_.renderer->wait(); !done) return done;
    if (options_.explain) print_explanation(*scene_.renderer);
    return {};
}

Result<void> Session::frame() {
    window_.poll(hidden_ ? kHiddenWait : 0.0);
    const double now = wall_seconds();
    frame_seconds_ = now - std::exchange(frame_start_, now);
    times_.add(frame_seconds_);
    const FramebufferSize size = window_.framebuffer_size();
    swapchain_->resize(size.width, size.height);
    const Wishes wishes = read_wishes(window_.input());
    obey(wishes);
    hidden_ = size.empty();
    if (hidden_) return {};
    if (state_.open_scene) switch_scene(*std::exchange(state_.open_scene, std::nullopt));
    scene_.renderer->resize(size.width, size.height);
    if (auto applied = apply_state(); !applied) return applied;
    reload_shaders();
    if (wishes.screenshot) {
        if (auto saved = screenshot("screenshot"); !saved) return saved;
    }
    if (pictures_left_ > 0) {
        if (auto saved = turntable_picture(); !saved) return saved;
    }
    return show();
}

void Session::obey(const Wishes& wishes) {
    if (wishes.quit) window_.close();
    if (wishes.pause) state_.paused = !state_.paused;
    if (wishes.step) state_.paused = state_.step = true;
    if (wishes.help) {
        state_.help = !state_.help;
        if (state_.help) fmt::print("{}", controls_help());
    }
    if (wishes.panels) state_.panels = !state_.panels;
    if (wishes.accuracy) {
        const auto there = open_accuracy();
        if (!there) log_error("{}", there.error().message());
        state_.accuracy = there && !state_.accuracy;
    }
    if (wishes.home) state_.camera = CameraMode::kScene;
    if (wishes.next_camera) {
        const int modes = scene_.player ? 4 : 3;
        state_.camera = static_cast<CameraMode>((static_cast<int>(state_.camera) + 1) % modes);
        log_info("camera={}", text(state_.camera));
    }
    if (wishes.turntable) {
        state_.turntable = !state_.turntable;
        log_info("turntable {}", state_.turntable ? "on" : "off");
    }
    if (wishes.turntable_pictures) pictures_left_ = kTurntablePictures;
    if (wishes.next_scene) state_.open_scene = (state_.scene + 1) % state_.scenes.size();
    if (wishes.hours != 0.0 && scene_.daylight) {
        state_.hour = std::clamp(scene_.daylight->hour() + wishes.hours, 0.0, 24.0);
        log_info("time of day {:.1f}", *state_.hour);
    }
    if (wishes.taa) {
        auto& taa = world().resource<temporal::TemporalSettings>();
        taa.enabled = !taa.enabled;
        log_info("TAA {}", taa.enabled ? "on" : "off");
    }
    if (wishes.next_technique) next_technique(world(), *wishes.next_technique);
    std::fflush(stdout);
}

Result<void> Session::apply_state() {
    const bool moves = !state_.paused || std::exchange(state_.step, false);
    const double seconds = std::min(frame_seconds_, kLongestStep);
    const double dt = moves ? (options_.real_time ? seconds : options_.dt) * state_.speed : 0.0;
    world().resource<scene::FixedStep>().dt = dt;
    if (state_.hour && scene_.daylight) {
        const double hour = *std::exchange(state_.hour, std::nullopt);
        if (auto set = scene_.daylight->set_hour(hour, *scene_.renderer, device_); !set) return set;
    }
    Viewer& viewer = *scene_.viewer;
    viewer.set_mode(state_.camera);
    const Input& input = window_.input();
    std::optional<glm::dvec3> player;
    if (scene_.player) {
        if (state_.camera != CameraMode::kFree) {
            const glm::dvec3 wish = movement(input);
            // Whoever walks wants to be seen walking.
            if (wish.x != 0.0 || wish.z != 0.0) viewer.set_mode(CameraMode::kFollow);
            scene_.player->update(world(), wish, viewer.yaw(), dt);
        }
        player = scene_.player->position(world());
    }
    const bool panels_have_mouse =
        panels_ && (state_.panels || state_.help || state_.accuracy) && panels_->takes_mouse();
    viewer.update(panels_have_mouse ? nullptr : &input,
                  static_cast<double>(window_.framebuffer_size().height), seconds, player);
    if (state_.turntable) viewer.turn(kTurntableSpeed * seconds);
    state_.camera = viewer.mode();
    return {};
}

/// The table of measurements, when it is first asked for.
Result<void> Session::open_accuracy() {
    if (accuracy_) return {};
    auto table = load_accuracy_or_default(options_.accuracy);
    if (!table) return table.error();
    accuracy_.emplace(std::move(*table));
    return {};
}

Result<void> Session::keep_to_budget() {
    const auto share = watch_.add(scene_.renderer->report());
    if (!share) return {};
    return spend_budget(world(), accuracy_->table(), *share, *options_.budget_ms);
}

void Session::describe_panels() {
    panels_->begin(window_.input(), window_.framebuffer_size(), frame_seconds_);
    if (state_.panels) main_panel(state_, times_, scene_.daylight.get(), *scene_.renderer);
    if (state_.help) help_panel(state_);
    if (state_.accuracy) {
        accuracy_->show(state_, world(), scene_.renderer->report(),
                        options_.budget_ms.value_or(0.0));
    }
    panels_->end();
}

Result<void> Session::show() {
    if (!panels_ && (state_.panels || state_.help || state_.accuracy)) {
        auto panels = Panels::create(device_);
        if (!panels) return panels.error();
        panels_ = std::move(*panels);
        scene_.renderer->set_overlay(
            [this](scene::RenderFrame& frame) { panels_->describe(frame); });
    }
    if (panels_) describe_panels();
    if (options_.budget_ms) {
        if (auto kept = keep_to_budget(); !kept) return kept;
    }
    if (auto drawn = scene_.renderer->draw(Output::kPicture); !drawn) return drawn;
    const gpu::Image& picture = scene_.renderer->picture();
    auto shown = swapchain_->present(picture.handle(), picture.info().width, picture.info().height);
    if (!shown) return shown.error();
    hidden_ = *shown == gpu::Presented::kHidden;
    count_frame();
    return {};
}

/// An extra frame to the CPU; a picture that cannot be written is no reason to end.
Result<void> Session::screenshot(const std::string& stem) {
    if (auto drawn = scene_.renderer->draw(Output::kPixels); !drawn) return drawn;
    if (auto done = scene_.renderer->wait(); !done) return done;
    if (auto saved = save_numbered(options_.out, stem, scene_.renderer->pixels()); !saved) {
        log_error("{}", saved.error().message());
    }
    return {};
}

Result<void> Session::turntable_picture() {
    --pictures_left_;
    scene_.viewer->turn(2.0 * std::acos(-1.0) / kTurntablePictures);
    state_.camera = scene_.viewer->mode();
    world().resource<scene::ViewSettings>().cut = true;
    for (uint32_t i = 0; i < kSettleFrames; ++i) {
        if (auto drawn = scene_.renderer->draw(Output::kNowhere); !drawn) return drawn;
    }
    return screenshot("turntable");
}

/// A scene that cannot be opened leaves the old one.
void Session::switch_scene(size_t index) {
    Options options = options_;
    options.scene = state_.scenes[index];
    auto scene = open_scene(device_, options, window_.framebuffer_size());
    if (!scene) {
        log_error("{}", scene.error().message());
        return;
    }
    static_cast<void>(scene_.renderer->wait());
    panels_.reset();
    if (accuracy_) accuracy_->forget();
    watch_ = {};
    scene_ = std::move(*scene);
    options_ = options;
    state_.scene = index;
    state_.camera = CameraMode::kScene;
    log_info("scene {}", options.scene.stem().string());
}

void Session::reload_shaders() {
#ifndef NDEBUG
    if (wall_seconds() < next_reload_) return;
    next_reload_ = wall_seconds() + 0.5;
    // A shader that does not compile was reported; the old one goes on.
    static_cast<void>(device_.pipelines().reload_changed());
#endif
}

void Session::count_frame() {
    ++frames_;
    if (options_.frames != 0 && frames_ == options_.frames) window_.close();
    const double now = wall_seconds();
    if (now - title_time_ < kTitleSeconds) return;
    const double frame_seconds = (now - title_time_) / (frames_ - title_frames_);
    if (title_frames_ > 0) {
        window_.set_title(fmt::format("Vellus: {:.1f} fps, {:.1f} ms{} (F1: keys, Tab: panels)",
                                      1.0 / frame_seconds, 1e3 * frame_seconds,
                                      state_.paused ? ", paused" : ""));
    }
    title_time_ = now;
    title_frames_ = frames_;
}

}  // namespace vellus::demo
