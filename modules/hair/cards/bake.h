#pragma once

#include <span>

#include "modules/hair/cards/card_groom.h"
#include "modules/hair/cards/ribbon.h"

namespace vellus::hair {

/// How finely a card is baked.
struct BakeSettings {
    glm::uvec2 size{16};     ///< texels
    uint32_t samples = 4;    ///< per texel and axis
    float tip_scale = 1.0f;  ///< of strand widths, as in HairWidth
};

/// The texels of one card: its strands as lines of their width, projected along the ribbon's
/// `toward` axis onto its middle, seen from its front. Opacity is the share of samples that a
/// strand covers; the other columns are means over what the samples see; tangents that oppose
/// each other count as one direction. Texels without hair
/// continue their neighbours, so that filters find no seam.
CardAtlas bake_card(const StrandData& strands, std::span<const uint32_t> members,
                    const Ribbon& ribbon, const BakeSettings& settings);

}  // namespace vellus::hair
