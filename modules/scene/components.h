#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>

#include "engine/asset/scene_asset.h"
#include "engine/ecs/entity.h"

// What a node of a scene is made of. Metres, radians, Y up, right-handed.
namespace vellus::scene {

/// Placement in the parent's frame. Translation is double so that a root may lie 1e6 m away.
struct LocalTransform {
    glm::dvec3 translation{0.0};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
};

/// Local to world, this frame; written by propagate_transforms.
struct WorldTransform {
    glm::dmat4 matrix{1.0};
};

/// Local to world, last frame. Until `known` (spawned, teleported) it follows the current one, so
/// that nothing gets a false velocity.
struct PreviousWorldTransform {
    glm::dmat4 matrix{1.0};
    bool known = false;
};

/// Absent on roots; a parent that is gone makes its children roots.
struct Parent {
    Entity entity;
};

struct Name {
    std::string value;
};

/// Which node of which instance in the SceneLibrary an entity came from.
struct NodeRef {
    uint32_t instance = asset::kNone;
    uint32_t node = asset::kNone;
};

/// On the entity above a scene's roots: move it to place the whole instance.
struct InstanceRoot {
    uint32_t instance = asset::kNone;
};

/// Perspective, looking along -Z of its WorldTransform; the far plane is infinitely far.
struct Camera {
    float vertical_fov = 0.8f;
    float near_plane = 0.1f;
};

/// Marks the camera that is drawn from.
struct ActiveCamera {};

/// A glTF mesh at this node; `skin` is kNone for rigid meshes. Indices into the instance's asset.
struct MeshInstance {
    uint32_t asset = asset::kNone;
    uint32_t mesh = asset::kNone;
    uint32_t skin = asset::kNone;
};

/// A punctual light shining along -Z of its WorldTransform; units of KHR_lights_punctual.
struct Light {
    asset::LightKind kind = asset::LightKind::kDirectional;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;
    float range = 0.0f;
    float inner_cone = 0.0f;
    float outer_cone = 0.785398f;
};

/// The node's glTF extensions that the engine does not know, as JSON; lives as long as the asset
/// in the SceneLibrary.
struct NodeExtensions {
    std::span<const asset::Extension> list;
};

}  // namespace vellus::scene
