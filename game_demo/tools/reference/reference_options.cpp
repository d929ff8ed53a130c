#include "game_demo/tools/reference/reference_options.h"

#include <CLI/CLI.hpp>
#include <ostream>

#include "game_demo/src/option_values.h"

namespace vellus::demo {

namespace {

constexpr uint32_t kMaxSamples = 1u << 24U;

/// Takes the value over, or hands its Error to CLI11.
template <class T>
void keep(const char* option, Result<T> value, T& slot) {
    if (!value) throw CLI::ValidationError(option, value.error().message());
    slot = std::move(*value);
}

void add_picture_options(CLI::App& app, ReferenceOptions& options) {
    app.add_option("scene", options.content.scene,
                   "A glTF scene (.gltf, .glb), or a groom (.hair, .tfx); the default scene if "
                   "none is given")
        ->type_name("SCENE.gltf|GROOM.hair|GROOM.tfx");
    app.add_option_function<std::string>(
           "--size",
           [&](const std::string& text) { keep("--size", read_size(text), options.content.size); },
           "Size of the picture, 1280x720 if not given")
        ->type_name("WxH");
    app.add_option("--spp", options.samples, "Samples per pixel")
        ->check(CLI::Range(1u, kMaxSamples))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("-o,--out", options.out,
                   "The picture: linear radiance with its standard error, OpenEXR")
        ->type_name("FILE.exr")
        ->capture_default_str();
    app.add_option("--png", options.png, "The same picture as the demo would show it")
        ->type_name("FILE.png");
    app.add_option("--depth", options.depth,
                   "Most scattering events of a path, 1 being direct light; 0 is no limit")
        ->type_name("D")
        ->capture_default_str();
}

void add_world_options(CLI::App& app, ReferenceOptions& options) {
    app.add_option("--frame", options.frame, "Which of the demo's frames, its first being 0")
        ->check(CLI::Range(0u, kMaxFrames))
        ->type_name("K")
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--dt",
           [&](const std::string& text) { keep("--dt", read_seconds(text), options.content.dt); },
           "Seconds from frame to frame; 1/60 if not given")
        ->type_name("S");
    app.add_option("--seed", options.content.seed, "Seed of everything random")
        ->type_name("S")
        ->capture_default_str();
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   keep("--set", read_technique(text), options.content.techniques.emplace_back());
               }
           },
           "Technique of all grooms on an axis. Only 'none' matters here: no hair between lights "
           "and hair (shadow), no scattered light (multiple), no environment. " +
               describe_techniques())
        ->type_name("AXIS=TECHNIQUE")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

void check_extension(const char* option, const std::filesystem::path& path, const char* extension) {
    if (path.empty() || path.extension() == extension) return;
    throw CLI::ValidationError(option,
                               fmt::format("'{}' does not end in {}", path.string(), extension));
}

}  // namespace

ParsedReferenceOptions parse_reference_options(int argc, const char* const* argv, std::ostream& out,
                                               std::ostream& err) {
    ParsedReferenceOptions parsed;
    CLI::App app("Path traces the scenes that the demo draws, from the same camera.",
                 "vellus_reference");
    app.footer(
        "Ctrl-C ends it with a picture of what there is; the same command goes on from there. "
        "Until "
        "a picture is done its sums lie beside it, in FILE.exr.checkpoint.");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_picture_options(app, parsed.options);
    add_world_options(app, parsed.options);
    const auto check = [&] {
        check_extension("--out", parsed.options.out, ".exr");
        check_extension("--png", parsed.options.png, ".png");
    };
    parsed.exit_status = parse_or_tell(app, argc, argv, check, out, err);
    return parsed;
}

}  // namespace vellus::demo
