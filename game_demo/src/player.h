#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "engine/ecs/ecs.h"
#include "engine/platform/result.h"
#include "game_demo/src/bystanders.h"
#include "game_demo/src/ground.h"

namespace vellus::demo {

constexpr const char* kPlayerExtensionName = "VELLUS_player";

/// VELLUS_player on a node: the character the user walks, and its clips.
struct PlayerExtension {
    std::string idle;    ///< name of the animation played while standing; may be empty
    std::string walk;    ///< and while walking, in place
    float speed = 1.3f;  ///< metres a second the walk clip is made for
};
/// Errors name field and remedy.
Result<PlayerExtension> parse_player_extension(std::string_view json, const std::string& where);

/// Walks a character over the ground and around others: eases speed and heading, mixes the clips.
/// Until the first step the scene's own animation has it.
class Player {
  public:
    /// The first node with VELLUS_player; null where the scene has none.
    static Result<std::unique_ptr<Player>> find(World& world);

    /// Towards `wish` (x right, z back, as seen by a camera of `yaw`), length up to 1.
    void update(World& world, const glm::dvec3& wish, double camera_yaw, double seconds);
    /// World position of the feet.
    [[nodiscard]] glm::dvec3 position(World& world) const;

  private:
    void leave_the_scenes_path(World& world);

    Ground ground_;
    Bystanders bystanders_;
    Entity node_ = kNoEntity;
    Entity instance_root_ = kNoEntity;
    uint32_t idle_ = 0;
    uint32_t walk_ = 0;
    double clip_speed_ = 1.3;
    double heading_ = 0.0;  ///< radians about +Y; 0 walks along +Z
    double speed_ = 0.0;    ///< metres a second
    bool moved_ = false;    ///< since the scene began
};

}  // namespace vellus::demo
