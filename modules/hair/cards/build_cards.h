#pragma once

#include <string>

#include "engine/platform/result.h"
#include "modules/hair/cards/card_groom.h"
#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// What cards to build from strands.
struct CardBuildOptions {
    /// At most this many, in [1, 65536]; 0: 300, or 900 to 4,000 where those would be stout or hair
    /// is gathered (CardReport), or one a strand where fewer than three would share a card then.
    uint32_t cards = 0;
    /// Texels across the cards per metre; 0: one per strand width. Fewer where `max_texels` asks.
    float texels_per_metre = 0.0f;
    /// Texels along the cards for each across them: strands change slowly along their length.
    float along_ratio = 0.2f;
    uint32_t max_texels = 1U << 22U;  ///< of the whole atlas
    uint32_t samples = 4;             ///< per texel and axis, in [1, 16]
    uint32_t max_rows = 48;           ///< of a card, in [2, 64]
    float tolerance = 0.001f;         ///< metres between a card's bend and its rows
    float tip_scale = 0.3f;           ///< width left at the strands' tips, as in HairWidth
};

/// What was built, and what it cost.
struct CardReport {
    size_t strands = 0;
    size_t cards = 0;
    /// Mean half thickness over mean length: from about 0.1 on too few cards hold the strands.
    float stoutness = 0.0f;
    /// Mean width at the roots over that along the whole card: from about 1.4 on hair is gathered,
    /// and few cards are too coarse for the head under it.
    float gathering = 0.0f;
    size_t triangles = 0;
    glm::uvec2 atlas_size{0};
    float texels_per_metre = 0.0f;  ///< across the cards
    double cluster_seconds = 0.0;
    double fit_seconds = 0.0;
    double bake_seconds = 0.0;
    uint64_t bytes = 0;
};

std::string to_text(const CardReport& report);

struct CardBuild {
    CardGroom cards;
    CardReport report;
};

/// Cards that read as the same hair: strands are clustered, each cluster gets a ribbon and its
/// rectangle of the atlas. The same strands and options give the same bytes. Errors: no strands, or
/// options outside their ranges.
Result<CardBuild> build_cards(const StrandData& strands, const CardBuildOptions& options);

}  // namespace vellus::hair
