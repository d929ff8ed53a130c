#include "modules/hair/cards/row_directions.h"

#include <cmath>

#include "engine/platform/jobs.h"

namespace vellus::hair {

namespace {

constexpr size_t kRowsPerJob = 16;
/// Strands that lead out of the card show so little of their length, squared, at least.
constexpr float kLeastShown = 0.04f;

/// What a texel says of the strands that cover it.
StrandArea strands_of(const glm::u8vec3& code, float opacity) {
    const glm::vec3 t(decode_signed(code.x), decode_signed(code.y), decode_signed(code.z));
    const float length = glm::length(t);
    if (length <= 0.0f) return {};
    const glm::vec3 d = t / length;
    return area_along(d, opacity / std::sqrt(glm::max(1.0f - d.z * d.z, kLeastShown)));
}

uint32_t texel_at(float share, uint32_t size) {
    const float texel = std::round(glm::clamp(share, 0.0f, 1.0f) * static_cast<float>(size));
    return static_cast<uint32_t>(texel);
}

/// Of the texels of a row whose first point is `first`: half way to its neighbours.
StrandArea directions_of(const CardGroom& cards, size_t first) {
    const CardAtlas& atlas = cards.atlas;
    const float v = cards.uvs[first].y;
    const float before = cards.parameters[first] > 0 ? cards.uvs[first - 3].y : v;
    const float after = cards.parameters[first] < 65535 ? cards.uvs[first + 3].y : v;
    const glm::uvec2 low(texel_at(cards.uvs[first].x, atlas.width),
                         texel_at(0.5f * (before + v), atlas.height));
    const glm::uvec2 high(texel_at(cards.uvs[first + 1].x, atlas.width),
                          texel_at(0.5f * (v + after), atlas.height));
    StrandArea sum;
    for (uint32_t y = low.y; y < high.y; ++y) {
        for (uint32_t x = low.x; x < high.x; ++x) {
            const size_t texel = size_t{y} * atlas.width + x;
            if (atlas.opacity[texel] == 0) continue;
            sum += strands_of(atlas.tangent[texel], static_cast<float>(atlas.opacity[texel]));
        }
    }
    if (sum.whole() <= 0.0f) return area_along({0.0f, 1.0f, 0.0f}, 1.0f);
    return sum.scaled(1.0f / sum.whole());
}

}  // namespace

std::vector<StrandArea> row_directions(const CardGroom& cards) {
    std::vector<StrandArea> rows(cards.ribbons ? cards.points.size() / 3 : 0);
    parallel_ranges(rows.size(), kRowsPerJob, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) rows[i] = directions_of(cards, 3 * i);
    });
    return rows;
}

}  // namespace vellus::hair
