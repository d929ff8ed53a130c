#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace vellus::light {

constexpr uint32_t kMaxLights = 4;
constexpr uint32_t kNoShadow = ~0u;

enum class PunctualKind : uint32_t { kSun = 0, kSpot = 1 };

/// Mirrors PunctualLight of shaders/light/lights.glsl, where the fields are explained.
struct PunctualLight {
    glm::mat4 to_hair{1.0f};
    glm::mat4 to_opaque{1.0f};
    glm::vec3 position{0.0f};
    PunctualKind kind = PunctualKind::kSun;
    glm::vec3 to_light{0.0f, 1.0f, 0.0f};
    float cone_scale = 0.0f;
    glm::vec3 color{0.0f};
    float cone_offset = 1.0f;
    uint32_t shadow_tile = kNoShadow;
    float hair_texel = 0.0f;
    float hair_range = 0.0f;
    uint32_t hair_size = 0;
    float opaque_texel = 0.0f;
    float opaque_range = 0.0f;
    uint32_t opaque_size = 0;
    uint32_t layers_size = 0;
    uint64_t hair_depth = 0;
    uint64_t hair_layers = 0;
    float layers_span = 0.0f;
    uint32_t padding = 0;
};
static_assert(sizeof(PunctualLight) == 232);

/// Mirrors the buffer Lights of shaders/light/lights.glsl (scalar layout).
struct LightBlock {
    uint32_t count = 0;
    uint32_t tiles = 0;
    std::array<glm::vec3, 9> environment{};
    uint32_t opaque_casters = 0;
    std::array<PunctualLight, kMaxLights> light{};
};
static_assert(sizeof(LightBlock) == 120 + 4 * 232);

}  // namespace vellus::light
