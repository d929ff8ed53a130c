#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "modules/hair/components.h"

namespace vellus::hair {

/// Cards cut across into rows, from root to tip: each row moves and turns as one, and the rows'
/// middles are the line along which a card follows its guides.
struct CardRows {
    std::vector<uint32_t> card_begin;  ///< first row of each card, and the end
    std::vector<uint32_t> row_begin;   ///< first of `points` of each row, and the end
    std::vector<uint32_t> points;      ///< of the groom
    uint32_t edge = 0;                 ///< a row's middle is the mean of up to so many first points
    float half_width = 0.0f;           ///< farthest a point is from its row's middle

    /// The middles of all rows of a card, from points of the whole groom.
    [[nodiscard]] std::vector<glm::vec3> line(std::span<const glm::vec3> at, uint32_t card) const;
};

/// Rows of a groom of cards: a ribbon's own, or, of an artist's mesh, points at about the same
/// share of the card's length.
CardRows cut_rows(const LibraryGroom& groom);

}  // namespace vellus::hair
