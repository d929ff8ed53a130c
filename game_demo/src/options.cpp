#include "game_demo/src/options.h"

#include <CLI/CLI.hpp>
#include <ostream>

#include "game_demo/src/option_values.h"

namespace vellus::demo {

namespace {

constexpr uint32_t kHeadlessFrames = 32;

/// Hands a value's text to `read`; what it does not like becomes CLI11's error for that option.
template <class Read>
std::function<void(const std::string&)> reading(const char* option, Read read) {
    return [option, read](const std::string& text) {
        if (auto done = read(text); !done) {
            throw CLI::ValidationError(option, done.error().message());
        }
    };
}

template <class T>
Result<void> keep(Result<T> value, T& slot) {
    if (!value) return value.error();
    slot = std::move(*value);
    return {};
}

void add_run_options(CLI::App& app, Options& options) {
    app.add_option("scene", options.scene,
                   "A glTF scene (.gltf, .glb), or a groom (.hair, .tfx); the default scene if "
                   "none is given")
        ->type_name("SCENE.gltf|GROOM.hair|GROOM.tfx");
    app.add_flag("--headless", options.headless, "No window: draw, write pictures and stats.json");
    app.add_option("--frames", options.frames,
                   "Frames to draw; in a window, until it is closed if not given")
        ->check(CLI::Range(1u, kMaxFrames))
        ->type_name("N");
    app.add_option("--warmup", options.warmup, "Frames drawn first, neither counted nor saved")
        ->check(CLI::Range(0u, kMaxFrames))
        ->type_name("N");
    app.add_option_function<std::string>(
           "--size",
           reading("--size",
                   [&](const std::string& text) { return keep(read_size(text), options.size); }),
           "Size of the picture, 1280x720 if not given")
        ->type_name("WxH");
    app.add_option("--out", options.out, "Folder for pictures and stats.json")
        ->type_name("DIR")
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--save",
           reading("--save",
                   [&](const std::string& text) { return keep(read_save(text), options.save); }),
           "Which frames become DIR/frame_NNNN.png; last if not given")
        ->type_name("all|last|K,...");
}

void add_world_options(CLI::App& app, Options& options) {
    app.add_option_function<std::string>(
           "--dt",
           reading("--dt",
                   [&](const std::string& text) {
                       options.real_time = false;
                       return keep(read_seconds(text), options.dt);
                   }),
           "Seconds from frame to frame; if not given 1/60, in a window as long as it took")
        ->type_name("S");
    app.add_option("--seed", options.seed, "Seed of everything random")
        ->type_name("S")
        ->capture_default_str();
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   auto choice = read_technique(text);
                   if (!choice) throw CLI::ValidationError("--set", choice.error().message());
                   options.techniques.push_back(std::move(*choice));
               }
           },
           "Technique of all grooms on an axis: " + describe_techniques())
        ->type_name("AXIS=TECHNIQUE")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

void add_device_options(CLI::App& app, Options& options) {
    app.add_option("--device", options.device, "Part of the GPU's name")->type_name("NAME");
    app.add_flag("--list-devices", options.list_devices, "Print the GPUs' names and end");
    app.add_flag("--no-taa", options.no_taa,
                 "Without temporal antialiasing; opacity=dither_still covers then too");
    app.add_flag("--validation", options.validation,
                 "Vulkan validation; ends with status 1 if it had anything to say");
    app.add_flag("--explain", options.explain,
                 "Print which effects the scene calls for and why, and the last frame's plan");
    app.add_option("--budget", options.budget_ms,
                   "Pick techniques and detail of each groom so that a frame takes MS milliseconds "
                   "of the device, from a table of vellus_accuracy; after a few frames that tell "
                   "how long it takes as it is")
        ->check(CLI::PositiveNumber)
        ->type_name("MS");
    app.add_option("--accuracy", options.accuracy,
                   "That table, also for F2; the one that came with the program if not given")
        ->check(CLI::ExistingFile)
        ->type_name("FILE.json");
    app.add_option_function<std::vector<std::string>>(
           "--graph-switch",
           [&](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   reading("--graph-switch", [&](const std::string& name) {
                       return read_switch(name, options.switches);
                   })(text);
               }
           },
           "Debugging aid of the frame graph, same picture: " + switch_names())
        ->type_name("SWITCH")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

/// What no single option can see.
void check_together(Options& options) {
    if (options.headless && options.frames == 0) options.frames = kHeadlessFrames;
    if (options.save.kind == SaveChoice::Kind::kListed && options.frames > 0 &&
        options.save.frames.back() >= options.frames) {
        throw CLI::ValidationError("--save",
                                   fmt::format("there is no frame {} (0 to {}, see --frames)",
                                               options.save.frames.back(), options.frames - 1));
    }
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err) {
    ParsedOptions parsed;
    CLI::App app("Draws hair in real time: a window to look around in, or pictures without one.",
                 "vellus_demo");
    app.footer(
        "In the window: drag to turn, right drag to move, scroll to come closer; H lists the "
        "keys.");
    // Scripts append their own: the last one counts.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_run_options(app, parsed.options);
    add_world_options(app, parsed.options);
    add_device_options(app, parsed.options);
    const auto check = [&] { check_together(parsed.options); };
    parsed.exit_status = parse_or_tell(app, argc, argv, check, out, err);
    return parsed;
}

}  // namespace vellus::demo
