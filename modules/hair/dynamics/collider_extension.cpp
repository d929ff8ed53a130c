#include "modules/hair/dynamics/collider_extension.h"

#include <fmt/format.h>

#include <array>

#include "engine/asset/json_fields.h"
#include "engine/platform/log.h"
#include "modules/scene/library.h"

namespace vellus::hair {

namespace {

constexpr double kFarthest = 1e6;

void read_point(asset::JsonFields& fields, std::string_view name, glm::vec3& point) {
    std::array<double, 3> numbers = {point.x, point.y, point.z};
    fields.numbers(name, -kFarthest, kFarthest, numbers);
    point = glm::vec3(numbers[0], numbers[1], numbers[2]);
}

}  // namespace

Result<ColliderExtension> parse_collider_extension(std::string_view json,
                                                   const std::string& where) {
    const auto parsed = asset::parse_json(json, where);
    if (!parsed) return parsed.error();
    asset::JsonFields fields(*parsed, where);
    ColliderExtension extension;
    HairCollider& collider = extension.collider;
    if (!fields.has("radius")) {
        fields.fail("radius", "is missing", "give the capsule's radius in the node's metres");
    }
    fields.number("radius", 1e-6, kFarthest, collider.radius);
    read_point(fields, "from", collider.from);
    collider.to = collider.from;
    read_point(fields, "to", collider.to);
    if (fields.error()) return *fields.error();
    extension.warnings = fields.unknown_fields();
    return extension;
}

Result<void> spawn_scene_colliders(World& world, uint32_t instance) {
    const auto& scenes = world.resource<scene::SceneLibrary>();
    const scene::SceneInstance& placed = scenes.instances[instance];
    const asset::SceneAsset& asset = scenes.asset_of(placed);
    for (size_t node = 0; node < asset.nodes.size(); ++node) {
        const std::string* json =
            scene::find_extension(asset.nodes[node].extensions, kColliderExtensionName);
        if (!json || placed.nodes[node] == kNoEntity) continue;
        auto read = parse_collider_extension(
            *json,
            fmt::format("{}: node {} '{}'", asset.path.string(), node, asset.nodes[node].name));
        if (!read) return read.error();
        for (const std::string& warning : read->warnings) log_warning("{}", warning);
        world.add(placed.nodes[node], read->collider);
    }
    return {};
}

}  // namespace vellus::hair
