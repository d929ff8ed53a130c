#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <optional>
#include <vector>

#include "modules/hair/groom/groom.h"

namespace vellus::hair {

/// Of CardAtlas::fibres; card_fibres() of shaders/hair/cards/cards.glsl divides by it.
constexpr float kFibreSteps = 16.0f;

/// What cards show, a value per texel, row by row from the top left.
struct CardAtlas {
    uint32_t width = 0;
    uint32_t height = 0;
    /// Share of the texel that strands cover, 255 all.
    std::vector<uint8_t> opacity;
    /// How far before the card's middle the strand lies, 128 on it, +-127 half its thickness.
    std::vector<uint8_t> depth;
    /// Arc length over strand length, 0 at the root to 255 at the tip; empty: that of the card.
    std::vector<uint8_t> parameter;
    /// Unit tangent root to tip, 128 + 127 (across, along, out of the card).
    std::vector<glm::u8vec3> tangent;
    /// Index of the strand in its groom, modulo 65536: seeds colour and dither; empty: a card is
    /// one strand.
    std::vector<uint16_t> strand;
    /// Strands over each other, the mean over the texel, kFibreSteps for each: what light on its
    /// way through meets. Empty: as many as would overlap by chance (of n strands that each cover
    /// p, (1 - p)^n is left open).
    std::vector<uint8_t> fibres;
    /// Colour of the strand, sRGB; empty where the groom has none of its own.
    std::vector<glm::u8vec3> color;

    [[nodiscard]] size_t texels() const { return size_t{width} * height; }
};

/// Hair as textured cards, in columns, in metres, Y up. Every vertex is a plain point, so whatever
/// moves points (a node, a skin, guides) moves cards.
///
/// Ribbons (built from strands) have three points a row: left edge, right edge, and the point half
/// a thickness before the middle; they turn with the eye as an elliptic tube would, so their volume
/// shows from every side. Other meshes (made by artists) have one point a vertex and stay as they
/// are.
struct CardGroom {
    bool ribbons = false;
    std::vector<glm::vec3> points;
    /// In the atlas, (0, 0) its top left corner; one per point.
    std::vector<glm::vec2> uvs;
    /// Points of each triangle; the third point of a ribbon's row is in none.
    std::vector<glm::uvec3> triangles;
    /// Card c has the points [card_begin[c], card_begin[c + 1]).
    std::vector<uint32_t> card_begin{0};
    /// Fraction of the card's length, 0 at the root to 65535 at the tip; one per point.
    std::vector<uint16_t> parameters;
    /// Points whose differences (y - x) and (w - z) lead along the card (to the tip) and across it;
    /// one per point, empty for ribbons.
    std::vector<glm::uvec4> frames;
    /// Metres that full depth lies before the card; ribbons have their third point instead.
    float depth_range = 0.0f;
    /// Linear colour of all cards where the groom gives one; multiplies the atlas's.
    std::optional<glm::vec3> color;
    CardAtlas atlas;

    [[nodiscard]] size_t card_count() const { return card_begin.size() - 1; }
    /// Of columns and atlas in memory.
    [[nodiscard]] uint64_t bytes() const;
};

Bounds bounds_of(const CardGroom& cards);

/// Mean linear colour of what the cards show, where they have one of their own.
std::optional<glm::vec3> mean_color(const CardGroom& cards);

/// Signed byte codes of depth and tangents: exact at 0 and +-1.
inline uint8_t encode_signed(float value) {
    return static_cast<uint8_t>(glm::round(glm::clamp(value, -1.0f, 1.0f) * 127.0f) + 128.0f);
}
inline float decode_signed(uint8_t code) {
    return glm::max((static_cast<float>(code) - 128.0f) / 127.0f, -1.0f);
}

}  // namespace vellus::hair
