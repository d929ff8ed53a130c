#include <fmt/ostream.h>

#include <filesystem>
#include <memory>

#include "engine/asset/gltf.h"
#include "engine/platform/clock.h"
#include "engine/platform/log.h"
#include "game_demo/src/progress.h"
#include "game_demo/tools/groom/command.h"
#include "game_demo/tools/groom/save.h"
#include "modules/hair/grow/grow.h"
#include "modules/hair/grow/region.h"

namespace vellus::groom_tool {

namespace {

using hair::GrowSettings;

struct Options {
    std::filesystem::path out;
    std::filesystem::path on;
    hair::RegionChoice region;
    std::vector<float> sphere;
    std::string style = "straight";
    std::string space = "scene";
    uint32_t seed = 0;
    double unit = 1.0;
    /// What was asked for besides the style, in the order of the command line.
    std::vector<std::function<void(GrowSettings&)>> changes;
};

Result<hair::GrowSurface> load_surface(const Options& options) {
    const bool fur = options.style == "fur";
    if (options.on.empty()) {
        const auto& s = options.sphere;
        return hair::sphere_surface({s[0], s[1], s[2]}, s[3], fur);
    }
    auto scene = asset::load_gltf(options.on);
    if (!scene) return scene.error();
    for (const std::string& warning : scene->warnings) log_warning("{}", warning);
    auto surface = hair::surface_from_scene(*scene, options.region);
    if (!surface || options.space == "scene") return surface;
    if (options.space == "mesh") return surface;
    auto node = hair::rest_transform(*scene, options.space);
    if (!node) return Error{node.error().what, "--space", node.error().remedy};
    surface->to_mesh = glm::inverse(*node);
    return surface;
}

Result<void> check_together(const Options& options) {
    if (!options.sphere.empty() && !(options.sphere[3] > 0.0f)) {
        return Error{fmt::format("radius {}", options.sphere[3]), "--sphere",
                     "give a radius above 0"};
    }
    if (!options.on.empty()) return {};
    if (options.sphere.empty()) {
        return Error{"no body to grow on", "vellus_groom generate",
                     "give --on MODEL.gltf, or --sphere X,Y,Z,R for a ball"};
    }
    const bool region = !options.region.group.empty() || !options.region.mesh.empty() ||
                        !options.region.mask.empty() || options.space != "scene";
    if (!region) return {};
    return Error{"--mesh, --group, --mask and --space need a model", "vellus_groom generate",
                 "give --on MODEL.gltf"};
}

/// From the scene's space to the one asked for.
void place(const Options& options, const hair::GrowSurface& surface, hair::Groom& groom) {
    if (options.space == "scene") return;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(surface.to_mesh))));
    for (glm::vec3& point : groom.points) {
        point = glm::vec3(surface.to_mesh * glm::dvec4(point, 1.0));
    }
    for (float& thickness : groom.thickness) thickness = static_cast<float>(thickness * scale);
    groom.default_thickness = static_cast<float>(groom.default_thickness * scale);
}

Result<void> run(Options options, std::ostream& out) {
    if (auto ok = check_target(options.out); !ok) return ok;
    if (auto ok = check_together(options); !ok) return ok;
    auto style = hair::grow_style(options.style);
    if (!style) return style.error();
    GrowSettings settings = hair::preset(*style);
    for (const auto& change : options.changes) change(settings);
    if (auto ok = hair::check(settings); !ok) {
        return Error{ok.error().what, "--" + ok.error().where, ok.error().remedy};
    }
    settings = hair::scale_to(settings, static_cast<float>(1.0 / options.unit));
    if (!options.sphere.empty()) {
        const auto& s = options.sphere;
        options.region.sphere = glm::vec4(s[0], s[1], s[2], s[3]);
    }
    auto surface = load_surface(options);
    if (!surface) return surface.error();

    const double start = wall_seconds();
    demo::Progress progress(100, "%");
    auto groom = hair::grow_groom(*surface, settings, options.seed, [&](float share) {
        progress.update(std::max(1u, static_cast<uint32_t>(100.0f * share)));
    });
    if (!groom) return groom.error();
    const double seconds = wall_seconds() - start;
    place(options, *surface, *groom);
    if (options.out.extension() != ".hair") groom->info.clear();
    // Placed in a space that somebody chose, a groom keeps its axes.
    const bool keep_axes = options.space != "scene" || options.unit != 1.0;
    if (auto saved = save(*groom, options.out, keep_axes, out); !saved) return saved;
    fmt::print(out, "{} hair on {:.1f} cm2 of skin, grown in {:.2f} s\n", options.style,
               1e4 * hair::haired_area(*surface) * options.unit * options.unit, seconds);
    return {};
}

void add_place_options(CLI::App& app, Options& options) {
    app.add_option("out", options.out, "The file to write: .hair, .tfx or .glb")
        ->required()
        ->type_name("FILE");
    app.add_option("--on", options.on, "The body: any glTF with triangles, in its rest pose")
        ->type_name("MODEL.gltf");
    app.add_option("--mesh", options.region.mesh,
                   "Only this mesh or node is haired; the others are in the way")
        ->type_name("NAME");
    app.add_option("--group", options.region.group,
                   "Where: a vertex attribute (_SCALP, COLOR_0.r, COLOR_1.g) or a joint's weight")
        ->type_name("NAME");
    app.add_option("--mask", options.region.mask,
                   "Where: a picture over TEXCOORD_0, white is haired")
        ->type_name("IMAGE.png");
    add_numbers(app, "--sphere", 4,
                "Where: inside this ball; without --on, the ball itself is the head",
                [&options](const std::vector<float>& numbers) { options.sphere = numbers; })
        ->type_name("X,Y,Z,R");
    app.add_option("--space", options.space,
                   "Space of the strands: scene, mesh (its POSITION), or a node by name, to hang "
                   "the groom on it with \"upright\": false")
        ->type_name("scene|mesh|NODE")
        ->capture_default_str();
    app.add_option("--unit", options.unit, "Metres to a unit of the model, where it is not 1")
        ->check(CLI::Range(1e-6, 1e6))
        ->type_name("M");
    app.add_option("--seed", options.seed, "The same seed grows the same hair")
        ->type_name("S")
        ->capture_default_str();
}

template <class T>
void add_change(CLI::App& app, Options& options, const std::string& name, const std::string& help,
                T GrowSettings::*value) {
    app.add_option_function<T>(
           name,
           [&options, value](const T& given) {
               options.changes.push_back([=](GrowSettings& s) { s.*value = given; });
           },
           help)
        ->type_name("N");
}

void add_style_options(CLI::App& app, Options& options) {
    app.add_option("--style", options.style,
                   fmt::format("{}", fmt::join(hair::grow_style_names(), ", ")))
        ->type_name("STYLE")
        ->capture_default_str();
    add_change(app, options, "--count", "strands; 0: from --density", &GrowSettings::count);
    add_change(app, options, "--points", "points of each strand", &GrowSettings::points);
    add_change(app, options, "--guides", "strands traced; the others lie between them",
               &GrowSettings::guides);
    for (const hair::GrowField& field : hair::grow_fields()) {
        add_change(app, options, fmt::format("--{}", field.name),
                   fmt::format("{} ({} to {})", field.help, field.low, field.high), field.value);
    }
    add_numbers(
        app, "--comb", 3, "where short hair and fur are combed; the face looks along +Z",
        [&options](const std::vector<float>& v) {
            options.changes.push_back([=](GrowSettings& s) { s.comb = {v[0], v[1], v[2]}; });
        })
        ->type_name("X,Y,Z");
}

Action attach(CLI::App& app) {
    auto options = std::make_shared<Options>();
    add_place_options(app, *options);
    add_style_options(app, *options);
    return [options](std::ostream& out) { return run(*options, out); };
}

}  // namespace

const Command kGenerate{"generate", "Grows a groom on a body", attach};

}  // namespace vellus::groom_tool
