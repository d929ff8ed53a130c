#pragma once

#include <glm/glm.hpp>

#include "engine/gpu/vulkan.h"

namespace vellus::hair {

/// Push constants of shaders/hair/binding/skin_roots.comp.glsl.
struct SkinRootsPush {
    VkDeviceAddress vertices;
    VkDeviceAddress morphs;
    VkDeviceAddress palette;
    VkDeviceAddress previous_palette;
    VkDeviceAddress weights;
    VkDeviceAddress previous_weights;
    VkDeviceAddress moved;
    uint32_t vertex_count;
    uint32_t target_count;
};
static_assert(sizeof(SkinRootsPush) == 64);

/// Push constants of shaders/hair/binding/deform.comp.glsl.
struct DeformPush {
    VkDeviceAddress roots;
    VkDeviceAddress moved;
    VkDeviceAddress local;
    VkDeviceAddress points;
    VkDeviceAddress previous_points;
    uint32_t strand_count;
    float scale;
    float previous_scale;
    float handedness;
};
static_assert(sizeof(DeformPush) == 56);

/// Push constants of shaders/hair/binding/carry.comp.glsl.
struct CarryPush {
    glm::mat4x3 node;
    glm::mat4x3 previous_node;
    VkDeviceAddress positions;
    VkDeviceAddress points;
    uint32_t point_count;
    uint32_t padding = 0;
};
static_assert(sizeof(CarryPush) == 120);

/// Bytes of one MovedVertex of bound_roots.glsl.
constexpr uint64_t kMovedVertexBytes = 48;

}  // namespace vellus::hair
