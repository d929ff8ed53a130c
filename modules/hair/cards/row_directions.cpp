#include "modules/hair/cards/row_directions.h"

#include <cmath>

#include "engine/platform/jobs.h"

namespace vellus::hair {

namespace {

constexpr size_t kRowsPerJob = 16;
/// Strands that lead out of the card show so little of their length, squared, at least.
constexpr float kLeastShown = 0.04f;

struct Moments {
    float weight = 0.0f;
    glm::vec3 squares{0.0f};
    glm::vec3 products{0.0f};

    void add(const glm::u8vec3& code, float opacity) {
        glm::vec3 t(decode_signed(code.x), decode_signed(code.y), decode_signed(code.z));
        const float length = glm::length(t);
        if (length <= 0.0f) return;
        t /= length;
        opacity /= std::sqrt(glm::max(1.0f - t.z * t.z, kLeastShown));
        weight += opacity;
        squares += opacity * t * t;
        products += opacity * glm::vec3(t.x * t.y, t.y * t.z, t.z * t.x);
    }
};

uint32_t texel_at(float share, uint32_t size) {
    const float texel = std::round(glm::clamp(share, 0.0f, 1.0f) * static_cast<float>(size));
    return static_cast<uint32_t>(texel);
}

/// Of the texels of a row whose first point is `first`: half way to its neighbours.
RowDirections directions_of(const CardGroom& cards, size_t first) {
    const CardAtlas& atlas = cards.atlas;
    const float v = cards.uvs[first].y;
    const float before = cards.parameters[first] > 0 ? cards.uvs[first - 3].y : v;
    const float after = cards.parameters[first] < 65535 ? cards.uvs[first + 3].y : v;
    const glm::uvec2 low(texel_at(cards.uvs[first].x, atlas.width),
                         texel_at(0.5f * (before + v), atlas.height));
    const glm::uvec2 high(texel_at(cards.uvs[first + 1].x, atlas.width),
                          texel_at(0.5f * (v + after), atlas.height));
    Moments moments;
    for (uint32_t y = low.y; y < high.y; ++y) {
        for (uint32_t x = low.x; x < high.x; ++x) {
            const size_t texel = size_t{y} * atlas.width + x;
            if (atlas.opacity[texel] == 0) continue;
            moments.add(atlas.tangent[texel], static_cast<float>(atlas.opacity[texel]));
        }
    }
    if (moments.weight <= 0.0f) return {};
    return {moments.squares / moments.weight, moments.products / moments.weight};
}

}  // namespace

float RowDirections::seen_along(glm::vec3 direction) const {
    const glm::vec3& d = direction;
    const float hidden = glm::dot(squares, d * d) +
                         2.0f * glm::dot(products, glm::vec3(d.x * d.y, d.y * d.z, d.z * d.x));
    return std::sqrt(glm::max(1.0f - hidden, 0.0f));
}

std::vector<RowDirections> row_directions(const CardGroom& cards) {
    std::vector<RowDirections> rows(cards.ribbons ? cards.points.size() / 3 : 0);
    parallel_ranges(rows.size(), kRowsPerJob, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) rows[i] = directions_of(cards, 3 * i);
    });
    return rows;
}

}  // namespace vellus::hair
