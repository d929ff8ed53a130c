#pragma once

#include <cstdint>
#include <vector>

#include "modules/hair/cards/card_groom.h"

namespace vellus::hair {

/// Levels of the atlas on the device; level 0 is the atlas, each further one half as large. Mirrors
/// kCardLevels of shaders/hair/cards/cards.glsl.
constexpr uint32_t kCardLevels = 5;

/// The atlas as the device reads it, a word per texel, levels one after the other.
struct AtlasLevels {
    std::vector<uint32_t> shape;   ///< opacity, depth, strand (16 bits), from the low byte up
    std::vector<uint32_t> strand;  ///< tangent across, along, toward, parameter
    std::vector<uint8_t> fibres;   ///< as the atlas has them
    std::vector<uint32_t> color;   ///< sRGB; empty where the atlas has none
};

/// Size of a level.
glm::uvec2 level_size(const CardAtlas& atlas, uint32_t level);

/// Prefilters for distance: the opacity of a texel is the mean of the four below it, so that a card
/// keeps its coverage at any distance, and its fibres alike; depth and colour are their means
/// weighted by opacity; strand, tangent and parameter are the most opaque one's, for the mean of
/// hair that crosses leads nowhere.
AtlasLevels make_levels(const CardAtlas& atlas);

}  // namespace vellus::hair
