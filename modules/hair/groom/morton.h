#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace vellus::hair {

/// Spreads ten bits three apart.
inline uint32_t spread_bits(uint32_t bits) {
    bits = (bits | (bits << 16U)) & 0x030000FFU;
    bits = (bits | (bits << 8U)) & 0x0300F00FU;
    bits = (bits | (bits << 4U)) & 0x030C30C3U;
    return (bits | (bits << 2U)) & 0x09249249U;
}

/// Place of a point of the unit cube along a Morton curve of 1024³ cells: near on it is near in
/// space.
inline uint32_t morton_code(glm::vec3 unit) {
    const glm::uvec3 cell(glm::clamp(unit, 0.0f, 1.0f) * 1023.0f);
    return spread_bits(cell.x) | (spread_bits(cell.y) << 1U) | (spread_bits(cell.z) << 2U);
}

}  // namespace vellus::hair
