#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/gpu/vulkan.h"

// Mirrors shaders/character/mesh_data.glsl and the push constants of its shaders (scalar layout).
namespace vellus::character {

struct RestVertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    glm::u16vec4 joints{0};
    glm::vec4 weights{1.0f, 0.0f, 0.0f, 0.0f};
};
static_assert(sizeof(RestVertex) == 48);

struct MorphDelta {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
};
static_assert(sizeof(MorphDelta) == 24);

struct SkinnedVertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 previous;
};
static_assert(sizeof(SkinnedVertex) == 36);

/// A CoveredVertex in a frame.
struct SkinnedCover {
    glm::vec3 share;  ///< of the sky's light that arrives
    glm::vec3 lean;
};
static_assert(sizeof(SkinnedCover) == 24);

struct SkinPush {
    VkDeviceAddress rest = 0;
    VkDeviceAddress morphs = 0;
    VkDeviceAddress weights = 0;
    VkDeviceAddress previous_weights = 0;
    VkDeviceAddress palette = 0;
    VkDeviceAddress previous_palette = 0;
    VkDeviceAddress skinned = 0;
    uint32_t vertex_count = 0;
    uint32_t target_count = 0;
    uint32_t has_joints = 0;
    float cover_thickness = 0.0f;
    VkDeviceAddress cover = 0;
    VkDeviceAddress skinned_cover = 0;
    glm::vec3 cover_forward{0.0f};
    glm::vec3 cover_backward{0.0f};
};
static_assert(sizeof(SkinPush) == 112);

struct MeshPush {
    VkDeviceAddress vertices = 0;
    VkDeviceAddress texcoords = 0;
    VkDeviceAddress colors = 0;
    VkDeviceAddress cover = 0;
    glm::vec4 base_color{1.0f};
    glm::vec3 emissive{0.0f};
    float metallic = 1.0f;
    float roughness = 1.0f;
    float alpha_cutoff = 0.0f;
    float back_flip = 1.0f;
    float front_flip = 1.0f;
    float hair_falloff = 0.0f;
    uint32_t unused = 0;
};
static_assert(sizeof(MeshPush) == 88);

struct ShadowPush {
    glm::mat4 to_shadow{1.0f};
    VkDeviceAddress vertices = 0;
};
static_assert(sizeof(ShadowPush) == 72);

}  // namespace vellus::character
