#include "game_demo/src/content.h"

#include <algorithm>

#include "engine/asset/gltf.h"
#include "engine/platform/log.h"
#include "modules/character/components.h"
#include "modules/hair/cards/card_file.h"
#include "modules/hair/components.h"
#include "modules/hair/spawn.h"
#include "modules/light/load_environment.h"
#include "modules/scene/camera.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/view.h"
#include "modules/temporal/temporal.h"

namespace vellus::demo {

namespace {

// A little from the side and above: a head shows its face and the fall of its hair.
constexpr double kDefaultYaw = 0.35;
constexpr double kDefaultPitch = 0.08;

bool is_gltf(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return std::tolower(c); });
    return extension == ".gltf" || extension == ".glb";
}

/// A glTF file of nothing but lines is a groom.
bool is_groom(const asset::SceneAsset& scene) {
    if (hair::says_cards(scene)) return true;
    bool lines = false;
    for (const asset::Mesh& mesh : scene.meshes) {
        for (const asset::Primitive& primitive : mesh.primitives) {
            if (primitive.topology == asset::Topology::kTriangles) return false;
            lines |= primitive.topology != asset::Topology::kPoints;
        }
    }
    return lines;
}

Result<LoadedContent> use_default_sky(ContentHost& host) {
    light::EnvironmentImage sky = light::sky_environment({});
    sky.exposure = light::kSkyExposure;
    if (auto made = host.set_environment(sky); !made) return made.error();
    return LoadedContent{.default_sky = true};
}

Result<LoadedContent> load_environment(ContentHost& host, const asset::SceneAsset& scene) {
    const std::string* json =
        scene::find_extension(scene.extensions, light::kEnvironmentExtensionName);
    if (!json) return use_default_sky(host);
    auto environment = light::parse_environment_extension(*json, scene.path.string());
    if (!environment) return environment.error();
    for (const std::string& warning : environment->warnings) log_warning("{}", warning);
    auto image = light::read_environment(*environment, scene.path.parent_path());
    if (!image) return image.error();
    if (auto made = host.set_environment(*image); !made) return made.error();
    return LoadedContent{};
}

hair::AddGroom adding_to(ContentHost& host) {
    return [&host](const std::filesystem::path& path, const hair::HairExtension& look) {
        return host.add_groom(path, look);
    };
}

Result<LoadedContent> load_scene(ContentHost& host,
                                 const std::shared_ptr<const asset::SceneAsset>& scene) {
    World& world = host.world();
    for (const std::string& warning : scene->warnings) log_warning("{}", warning);
    auto instance = scene::instantiate(world, scene);
    if (!instance) return instance.error();
    if (auto meshes = host.add_meshes(); !meshes) return meshes.error();
    const hair::HairKeeper keeper{
        adding_to(host), [&](Entity hair, Entity mesh) { return host.bind_hair(hair, mesh); },
        [&](Entity hair, const hair::MotionChoice& motion) {
            return host.move_hair(hair, motion);
        }};
    if (auto hair = hair::spawn_scene_hair(world, keeper, *instance); !hair) return hair.error();
    if (!scene->animations.empty()) {
        const Entity root = world.resource<scene::SceneLibrary>().instances[*instance].root;
        world.add(root, character::AnimationPlayer{});
    }
    return load_environment(host, *scene);
}

Result<LoadedContent> load_file(ContentHost& host, const std::filesystem::path& path) {
    if (is_gltf(path)) {
        auto scene = asset::load_gltf(path);
        if (!scene) return scene.error();
        if (!is_groom(*scene)) {
            return load_scene(host, std::make_shared<const asset::SceneAsset>(std::move(*scene)));
        }
    }
    auto hair = hair::spawn_hair(host.world(), adding_to(host), path, {}, kNoEntity);
    if (!hair) return hair.error();
    return use_default_sky(host);
}

template <class Component>
Entity first_with(World& world) {
    Entity first = kNoEntity;
    world.query<Entity, const Component>().each([&](Entity entity, const Component&) {
        if (first == kNoEntity || entity.index < first.index) first = entity;
    });
    return first;
}

void set_techniques(World& world, const std::vector<TechniqueChoice>& choices) {
    world.query<hair::HairTechniques>().each([&](hair::HairTechniques& techniques) {
        for (const TechniqueChoice& choice : choices) {
            const auto set = hair::set_technique(techniques, choice.axis, choice.technique);
            assert(set);
            static_cast<void>(set);
        }
    });
}

/// What the picture should hold: outermost points of hair, corners of everything else.
std::vector<glm::dvec3> outline_of(World& world) {
    std::vector<glm::dvec3> points;
    world.query<const scene::WorldBounds, Without<hair::Hair>>().each(
        [&](const scene::WorldBounds& bounds) {
            if (bounds.box.empty()) return;
            const auto corners = bounds.box.corners();
            points.insert(points.end(), corners.begin(), corners.end());
        });
    const auto& grooms = world.resource<hair::HairLibrary>().grooms;
    world.query<const hair::Hair, const scene::WorldTransform>().each(
        [&](const hair::Hair& hair, const scene::WorldTransform& transform) {
            for (const glm::vec3& point : grooms[hair.groom].outermost) {
                points.emplace_back(transform.matrix * glm::dvec4(point, 1.0));
            }
        });
    return points;
}

Result<void> place_camera(ContentHost& host) {
    World& world = host.world();
    if (const Entity camera = first_with<scene::Camera>(world); camera != kNoEntity) {
        world.add(camera, scene::ActiveCamera{});
        return host.settle();
    }
    if (auto settled = host.settle(); !settled) return settled;
    const glm::dvec2 size(world.resource<scene::ViewSettings>().size);
    const scene::CameraPose pose =
        scene::frame_points(outline_of(world), kDefaultYaw, kDefaultPitch, size.x / size.y);
    scene::spawn_camera(world, pose);
    return host.settle();
}

}  // namespace

std::filesystem::path content_path(const Options& options) {
    if (!options.scene.empty()) return options.scene;
    return scene_folder() / "portrait.gltf";
}

std::filesystem::path scene_folder() {
    return std::filesystem::path(VELLUS_ASSET_DIR) / "scenes";
}

Result<LoadedContent> load_content(ContentHost& host, const Options& options) {
    World& world = host.world();
    auto& step = world.resource<scene::FixedStep>();
    step.dt = options.dt;
    step.seed = options.seed;
    host.resize(options.size[0], options.size[1]);
    auto loaded = load_file(host, content_path(options));
    if (!loaded) return loaded.error();
    if (first_with<scene::Light>(world) == kNoEntity) light::spawn_sun(world, {});
    set_techniques(world, options.techniques);
    if (auto* taa = world.find_resource<temporal::TemporalSettings>()) {
        taa->enabled = !options.no_taa;
    }
    if (auto placed = place_camera(host); !placed) return placed.error();
    return *loaded;
}

}  // namespace vellus::demo
