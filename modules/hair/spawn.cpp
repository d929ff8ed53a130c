#include "modules/hair/spawn.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <numbers>

#include "engine/platform/jobs.h"
#include "engine/platform/log.h"
#include "modules/hair/binding/bind_hair.h"
#include "modules/hair/cards/add_cards.h"
#include "modules/hair/cards/card_file.h"
#include "modules/hair/components.h"
#include "modules/hair/dynamics/collider_extension.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/groom/load_strands.h"
#include "modules/light/light_set.h"
#include "modules/scene/bounds.h"
#include "modules/scene/library.h"

namespace vellus::hair {

namespace {

std::optional<glm::vec3> constant_color(const StrandData& strands) {
    if (!strands.has_color || !strands.point_color.empty()) return std::nullopt;
    return glm::vec3(strands.color);
}

scene::LocalTransform local_transform(const HairExtension& look) {
    return {.translation = look.translation,
            .rotation = glm::quat(look.rotation),
            .scale = glm::vec3(look.scale)};
}

AddGroom adding_to(World& world, gpu::Device& device) {
    return [&world, &device](const std::filesystem::path& path, const HairExtension& look) {
        return add_groom(world, device, path, look);
    };
}

}  // namespace

std::vector<glm::vec3> outermost_points(const std::vector<glm::vec3>& points) {
    constexpr size_t kDirections = 256;  // spread over the sphere by a Fibonacci lattice
    constexpr size_t kSample = 1'000'000;
    std::vector<glm::vec3> result(points.empty() ? 0 : kDirections);
    // Odd, or strands of an even number of points would never show their tips.
    const size_t stride = (points.size() / kSample) | 1;
    parallel_ranges(result.size(), 16, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / kDirections;
            const float angle = 2.3999632f * static_cast<float>(i);
            const float across = std::sqrt(1.0f - y * y);
            const glm::vec3 direction(across * std::cos(angle), y, across * std::sin(angle));
            float farthest = std::numeric_limits<float>::lowest();
            for (size_t p = 0; p < points.size(); p += stride) {
                const float along = glm::dot(points[p], direction);
                if (along <= farthest) continue;
                farthest = along;
                result[i] = points[p];
            }
        }
    });
    return result;
}

std::optional<uint32_t> find_groom(const World& world, const std::string& name) {
    const auto& grooms = world.resource<HairLibrary>().grooms;
    const auto known = std::ranges::find(grooms, name, &LibraryGroom::name);
    if (known == grooms.end()) return std::nullopt;
    return static_cast<uint32_t>(known - grooms.begin());
}

/// Mean of the three views of the ellipsoid inside the box.
float layers_of(const StrandData& strands) {
    double length = 0.0;
    for (const float strand : strands.strand_length) length += strand;
    const glm::dvec3 size(strands.bounds.size());
    const double area =
        std::numbers::pi / 4.0 * (size.x * size.y + size.y * size.z + size.z * size.x) / 3.0;
    return area > 0.0 ? static_cast<float>(length / area) : 0.0f;
}

std::optional<glm::vec3> mean_color(const StrandData& strands) {
    if (strands.point_color.empty()) return constant_color(strands);
    glm::dvec3 sum(0.0);
    for (const glm::uvec2& halves : strands.point_color) {
        const glm::vec2 rg = glm::unpackHalf2x16(halves.x);
        sum += glm::dvec3(rg.x, rg.y, glm::unpackHalf2x16(halves.y).x);
    }
    return glm::vec3(sum / static_cast<double>(strands.point_color.size()));
}

LibraryGroom describe_groom(const std::string& name, const StrandData& strands,
                            const GroomReport& report) {
    return {.name = name,
            .positions = strands.positions,
            .strand_begin = strands.strand_begin,
            .levels = strands.levels,
            .layers = layers_of(strands),
            .bounds = strands.bounds,
            .outermost = outermost_points(strands.positions),
            .width = strands.width,
            .has_width_column = !strands.point_width.empty(),
            .has_colors = !strands.point_color.empty(),
            .color = constant_color(strands),
            .mean_color = mean_color(strands),
            .report = report};
}

Result<uint32_t> add_groom(World& world, gpu::Device& device, const std::filesystem::path& path,
                           bool upright) {
    if (const auto known = find_groom(world, strands_name(path, upright))) return *known;
    auto cards = find_cards(path);
    if (!cards) return cards.error();
    if (*cards) return add_cards(world, device, strands_name(path, upright), **cards);
    auto loaded = load_strands(path, upright);
    if (!loaded) return loaded.error();
    return add_strands(world, device, loaded->name, loaded->strands, loaded->report);
}

Result<uint32_t> add_groom(World& world, gpu::Device& device, const std::filesystem::path& path,
                           const HairExtension& look) {
    if (!look.cards) return add_groom(world, device, path, look.upright);
    return add_built_cards(world, device, path, look);
}

Result<uint32_t> add_strands(World& world, gpu::Device& device, const std::string& name,
                             const StrandData& strands, const GroomReport& report) {
    auto buffers = StrandBuffers::upload(device, strands);
    if (!buffers) return buffers.error();
    auto& library = world.resource<HairLibrary>();
    library.grooms.push_back(describe_groom(name, strands, report));
    library.grooms.back().strands = std::move(*buffers);
    return static_cast<uint32_t>(library.grooms.size() - 1);
}

Result<Entity> spawn_hair(World& world, const AddGroom& add, const std::filesystem::path& path,
                          const HairExtension& look, Entity parent) {
    HairTechniques techniques = best_techniques();
    if (auto set = set_techniques(techniques, look.techniques); !set) return set.error();
    auto groom = add(path, look);
    if (!groom) return groom.error();
    return spawn_hair(world, *groom, look, techniques, parent);
}

Result<Entity> spawn_hair(World& world, gpu::Device& device, const std::filesystem::path& path,
                          const HairExtension& look, Entity parent) {
    return spawn_hair(world, adding_to(world, device), path, look, parent);
}

Entity spawn_hair(World& world, uint32_t groom, const HairExtension& look,
                  const HairTechniques& techniques, Entity parent) {
    const Entity entity =
        world.spawn(Hair{groom}, look.material, look.width, HairShadow{}, techniques,
                    local_transform(look), scene::WorldTransform{}, scene::PreviousWorldTransform{},
                    scene::WorldBounds{}, light::ShadowFocus{.hair = true});
    if (parent != kNoEntity) world.add(entity, scene::Parent{parent});
    return entity;
}

Result<void> spawn_scene_hair(World& world, const HairKeeper& keeper, uint32_t instance) {
    if (auto colliders = spawn_scene_colliders(world, instance); !colliders) return colliders;
    const auto& scenes = world.resource<scene::SceneLibrary>();
    const scene::SceneInstance& placed = scenes.instances[instance];
    const asset::SceneAsset& asset = scenes.asset_of(placed);
    for (size_t node = 0; node < asset.nodes.size(); ++node) {
        const std::string* json =
            scene::find_extension(asset.nodes[node].extensions, kHairExtensionName);
        if (!json || placed.nodes[node] == kNoEntity) continue;
        const std::string where =
            fmt::format("{}: node {} '{}'", asset.path.string(), node, asset.nodes[node].name);
        auto look = parse_hair_extension(*json, where);
        if (!look) return look.error();
        for (const std::string& warning : look->warnings) log_warning("{}", warning);
        const std::filesystem::path groom = asset.path.parent_path() / look->groom;
        auto spawned = spawn_hair(world, keeper.add_groom, groom, *look, placed.nodes[node]);
        if (!spawned) return spawned.error();
        if (look->binding) {
            auto carrier = find_binding_node(asset, *look->binding, where);
            if (!carrier) return carrier.error();
            auto bound = keeper.bind(*spawned, placed.nodes[*carrier]);
            if (!bound) return bound;
        }
        if (!look->motion || !keeper.move) continue;
        if (auto moving = keeper.move(*spawned, *look->motion); !moving) return moving;
    }
    return {};
}

Result<void> spawn_scene_hair(World& world, gpu::Device& device, uint32_t instance) {
    const auto bind = [&](Entity hair, Entity mesh) {
        return bind_hair(world, device, hair, mesh);
    };
    const auto move = [&](Entity hair, const MotionChoice& motion) {
        return add_motion(world, device, hair, motion.motion, motion.guides);
    };
    return spawn_scene_hair(world, {adding_to(world, device), bind, move}, instance);
}

}  // namespace vellus::hair
