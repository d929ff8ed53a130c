#pragma once

#include <glm/glm.hpp>

#include "engine/gpu/command_buffer.h"
#include "modules/hair/geometry/strand_buffers.h"

namespace vellus::hair {

/// Push constants of shaders/hair/geometry/project.comp.glsl.
struct ProjectPush {
    glm::mat4 to_clip;
    VkDeviceAddress positions;
    VkDeviceAddress parameters;
    VkDeviceAddress widths;
    VkDeviceAddress projected;
    glm::vec2 viewport;
    uint32_t point_count;
    float width;
    float tip_scale;
    float pixels_per_metre;
};
static_assert(sizeof(ProjectPush) == 120);

/// Push constants of shaders/hair/geometry/visibility.comp.glsl.
struct VisibilityPush {
    VkDeviceAddress projected;
    VkDeviceAddress segment_point;
    VkDeviceAddress segment_strand;
    VkDeviceAddress strand_seed;
    VkDeviceAddress target;
    glm::ivec2 size;
    uint32_t segment_count;
    uint32_t first_id;
    uint32_t frame;
    float alpha;
};
static_assert(sizeof(VisibilityPush) == 64);

constexpr uint32_t kStrandGroupSize = 64;
/// Bytes of one projected point: x, y in pixels, depth, width in pixels.
constexpr uint64_t kProjectedPointBytes = 16;

}  // namespace vellus::hair
