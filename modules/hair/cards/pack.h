#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace vellus::hair {

/// Rectangles of cards start and end on multiples of this: four halvings later a texel still
/// belongs to one card, so no mip bleeds and no padding is needed.
constexpr uint32_t kCardAlignment = 16;

/// Where each rectangle went, and the size of the whole.
struct Packing {
    std::vector<glm::uvec2> corners;
    glm::uvec2 size{0};
};

/// Packs rectangles on shelves, highest first (Coffman et al. 1980, next-fit decreasing height),
/// into about a square. Sizes are multiples of kCardAlignment.
Packing pack_shelves(std::span<const glm::uvec2> sizes);

}  // namespace vellus::hair
