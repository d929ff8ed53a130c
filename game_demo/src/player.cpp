#include "game_demo/src/player.h"

#include <algorithm>
#include <cmath>

#include "engine/asset/json_fields.h"
#include "engine/platform/log.h"
#include "modules/character/components.h"
#include "modules/scene/library.h"

namespace vellus::demo {

namespace {

constexpr double kSpeedTime = 0.18;  ///< seconds to two thirds of a new speed
constexpr double kTurnTime = 0.12;
constexpr double kHighestStep = 0.4;  ///< metres up that need no jump

/// Index of the animation of that name.
Result<uint32_t> clip_named(const asset::SceneAsset& scene, const std::string& name,
                            const char* field) {
    for (size_t i = 0; i < scene.animations.size(); ++i) {
        if (scene.animations[i].name == name) return static_cast<uint32_t>(i);
    }
    return Error{fmt::format("{} \"{}\" is no animation of the scene", field, name),
                 fmt::format("{}, {}", scene.path.string(), kPlayerExtensionName),
                 "name one of /animations"};
}

}  // namespace

Result<PlayerExtension> parse_player_extension(std::string_view json, const std::string& where) {
    const auto parsed = asset::parse_json(json, where);
    if (!parsed) return parsed.error();
    asset::JsonFields fields(*parsed, where);
    PlayerExtension player;
    fields.text("idle", player.idle);
    fields.text("walk", player.walk);
    if (player.walk.empty()) fields.fail("walk", "is missing or empty", "name an animation");
    fields.number("speed", 0.01, 100.0, player.speed);
    if (fields.error()) return *fields.error();
    for (const std::string& warning : fields.unknown_fields()) log_warning("{}", warning);
    return player;
}

Result<std::unique_ptr<Player>> Player::find(World& world) {
    const auto& library = world.resource<scene::SceneLibrary>();
    Entity found = kNoEntity;
    const std::string* json = nullptr;
    world.query<Entity, const scene::NodeExtensions>().each(
        [&](Entity entity, const scene::NodeExtensions& extensions) {
            const auto* text = scene::find_extension(extensions.list, kPlayerExtensionName);
            if (text == nullptr || (json != nullptr && entity.index > found.index)) return;
            found = entity;
            json = text;
        });
    if (json == nullptr) return std::unique_ptr<Player>();
    const scene::SceneInstance& instance =
        library.instances[world.get<scene::NodeRef>(found)->instance];
    const asset::SceneAsset& scene = library.asset_of(instance);
    auto extension = parse_player_extension(*json, scene.path.string());
    if (!extension) return extension.error();
    auto walk = clip_named(scene, extension->walk, "walk");
    if (!walk) return walk.error();
    auto idle = extension->idle.empty() ? walk : clip_named(scene, extension->idle, "idle");
    if (!idle) return idle.error();
    auto player = std::make_unique<Player>();
    player->node_ = found;
    player->instance_root_ = instance.root;
    player->walk_ = *walk;
    player->idle_ = *idle;
    player->clip_speed_ = extension->speed;
    player->ground_ = Ground(world);
    player->bystanders_ = Bystanders(world, found);
    return player;
}

/// From where its parents have brought it, the node goes on alone.
void Player::leave_the_scenes_path(World& world) {
    moved_ = true;
    const glm::dmat4 place = world.get<scene::WorldTransform>(node_)->matrix;
    heading_ = std::atan2(place[2].x, place[2].z);
    world.get<scene::LocalTransform>(node_)->translation = place[3];
    if (world.has<scene::Parent>(node_)) world.remove<scene::Parent>(node_);
}

void Player::update(World& world, const glm::dvec3& wish, double camera_yaw, double seconds) {
    const double length = std::min(std::hypot(wish.x, wish.z), 1.0);
    if (length > 0.0 && !moved_) leave_the_scenes_path(world);
    if (!moved_ || seconds <= 0.0) return;
    if (length > 0.0) {
        // The wish turned from the camera's frame into the world's.
        const double x = wish.x * std::cos(camera_yaw) + wish.z * std::sin(camera_yaw);
        const double z = wish.z * std::cos(camera_yaw) - wish.x * std::sin(camera_yaw);
        const double turn = std::remainder(std::atan2(x, z) - heading_, 2.0 * std::acos(-1.0));
        heading_ += turn * (1.0 - std::exp(-seconds / kTurnTime));
    }
    speed_ += (length * clip_speed_ - speed_) * (1.0 - std::exp(-seconds / kSpeedTime));
    auto& node = *world.get<scene::LocalTransform>(node_);
    node.rotation = glm::angleAxis(static_cast<float>(heading_), glm::vec3(0.0f, 1.0f, 0.0f));
    node.translation +=
        glm::dvec3(std::sin(heading_), 0.0, std::cos(heading_)) * (speed_ * seconds);
    node.translation = bystanders_.clear_of(world, node.translation);
    const glm::dvec3& at = node.translation;
    node.translation.y = ground_.height(at.x, at.z, at.y + kHighestStep).value_or(at.y);
    auto& clips = *world.get<character::AnimationPlayer>(instance_root_);
    const double walking = std::clamp(speed_ / clip_speed_, 0.0, 1.0);
    // The walk lies over the idle clip, which may move others of the scene as well; feet keep to
    // the ground they pass.
    clips.animation = idle_;
    clips.other = walk_;
    clips.other_speed = walking;
    if (walk_ == idle_) {
        clips.speed = walking;
        clips.mix = 0.0f;
    } else {
        clips.mix = static_cast<float>(std::min(2.0 * walking, 1.0));
    }
}

glm::dvec3 Player::position(World& world) const {
    return world.get<scene::WorldTransform>(node_)->matrix[3];
}

}  // namespace vellus::demo
