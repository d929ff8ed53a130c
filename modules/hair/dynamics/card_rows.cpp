#include "modules/hair/dynamics/card_rows.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vellus::hair {

namespace {

// Points of a mesh within this share of the card's length of a row's first are of that row.
constexpr uint32_t kRowHeight = 65535 / 40;

void add_ribbon(uint32_t first, uint32_t end, CardRows& rows) {
    for (uint32_t point = first; point < end; point += 3) rows.row_begin.push_back(point);
    rows.points.resize(end);
    std::iota(rows.points.begin() + first, rows.points.end(), first);
}

void add_mesh(const std::vector<uint16_t>& parameters, uint32_t first, uint32_t end,
              CardRows& rows) {
    const auto begin = static_cast<ptrdiff_t>(rows.points.size());
    rows.points.resize(end);
    std::iota(rows.points.begin() + begin, rows.points.end(), first);
    std::stable_sort(rows.points.begin() + begin, rows.points.end(),
                     [&](uint32_t a, uint32_t b) { return parameters[a] < parameters[b]; });
    uint32_t row_at = 0;
    for (uint32_t i = first; i < end; ++i) {
        const uint32_t at = parameters[rows.points[i]];
        if (i > first && at <= row_at + kRowHeight) continue;
        rows.row_begin.push_back(i);
        row_at = at;
    }
}

}  // namespace

std::vector<glm::vec3> CardRows::line(std::span<const glm::vec3> at, uint32_t card) const {
    std::vector<glm::vec3> middles;
    for (uint32_t row = card_begin[card]; row < card_begin[card + 1]; ++row) {
        const uint32_t end = std::min(row_begin[row + 1], row_begin[row] + edge);
        glm::vec3 sum(0.0f);
        for (uint32_t i = row_begin[row]; i < end; ++i) sum += at[points[i]];
        middles.push_back(sum / static_cast<float>(end - row_begin[row]));
    }
    return middles;
}

CardRows cut_rows(const LibraryGroom& groom) {
    CardRows rows;
    const bool ribbons = groom.cards.ribbons;
    // A ribbon's row is its two edges and a point before its middle.
    rows.edge = ribbons ? 2 : std::numeric_limits<uint16_t>::max();
    const size_t cards = groom.strand_begin.empty() ? 0 : groom.strand_begin.size() - 1;
    for (size_t card = 0; card < cards; ++card) {
        const uint32_t first = groom.strand_begin[card];
        const uint32_t end = groom.strand_begin[card + 1];
        rows.card_begin.push_back(static_cast<uint32_t>(rows.row_begin.size()));
        if (ribbons) {
            add_ribbon(first, end, rows);
        } else {
            add_mesh(groom.card_parameters, first, end, rows);
        }
    }
    rows.card_begin.push_back(static_cast<uint32_t>(rows.row_begin.size()));
    rows.row_begin.push_back(static_cast<uint32_t>(rows.points.size()));
    for (uint32_t card = 0; card < cards; ++card) {
        const std::vector<glm::vec3> middles = rows.line(groom.positions, card);
        for (uint32_t r = 0; r < middles.size(); ++r) {
            const uint32_t row = rows.card_begin[card] + r;
            for (uint32_t i = rows.row_begin[row]; i < rows.row_begin[row + 1]; ++i) {
                const float away = glm::distance(groom.positions[rows.points[i]], middles[r]);
                rows.half_width = std::max(rows.half_width, away);
            }
        }
    }
    return rows;
}

}  // namespace vellus::hair
