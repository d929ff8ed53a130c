#include <algorithm>
#include <array>
#include <cmath>

#include "engine/platform/jobs.h"
#include "modules/hair/cards/card_groom.h"
#include "modules/hair/cards/row_directions.h"
#include "modules/hair/environment/ambient_pieces.h"

namespace vellus::hair {

namespace {

constexpr float kPiecesAcross = 64.0f;  // along the groom's longest side
constexpr int kMostParts = 16;          // along a triangle's side
constexpr int kSamples = 8;             // of the atlas, along a part's side
constexpr float kMostCover = 0.999f;

/// Strands over each other at a place of the atlas; where it does not know, what they cover.
float strands_over(const CardAtlas& atlas, const glm::vec2& uv) {
    const glm::vec2 size(atlas.width, atlas.height);
    const glm::uvec2 at(glm::min(glm::clamp(uv, 0.0f, 1.0f) * size, size - 1.0f));
    const size_t texel = size_t{at.y} * atlas.width + at.x;
    return atlas.fibres.empty() ? static_cast<float>(atlas.opacity[texel]) / 255.0f
                                : static_cast<float>(atlas.fibres[texel]) / kFibreSteps;
}

/// A triangle of a card: corners, their places in the atlas, and where its strands lead, by area.
struct Facet {
    std::array<glm::vec3, 3> points;
    std::array<glm::vec2, 3> uvs;
    StrandArea strands;
    int parts = 1;  ///< along each side

    /// Place of the part in row `i`, column `j`; odd columns stand on their heads.
    [[nodiscard]] glm::vec3 weights(int i, int j, const glm::vec2& inside) const {
        const bool turned = (j & 1) != 0;
        const glm::vec2 corner = turned ? glm::vec2(j / 2 + 1, i + 1) : glm::vec2(j / 2, i);
        const glm::vec2 at = (corner + (turned ? -inside : inside)) / static_cast<float>(parts);
        return {1.0f - at.x - at.y, at.x, at.y};
    }
};

template <class T>
T blend(const std::array<T, 3>& values, const glm::vec3& weights) {
    return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

/// Mean of strands_over() over the part.
float mean_strands(const CardAtlas& atlas, const Facet& facet, int i, int j) {
    float sum = 0.0f;
    float count = 0.0f;
    for (int y = 0; y < kSamples; ++y) {
        for (int x = 0; x + y < kSamples; ++x) {
            const glm::vec2 inside = (glm::vec2(x, y) + 1.0f / 3.0f) / float{kSamples};
            sum += strands_over(atlas, blend(facet.uvs, facet.weights(i, j, inside)));
            count += 1.0f;
        }
    }
    return sum / count;
}

/// From root to tip at a point: between its row's neighbours, or as its frame says.
glm::vec3 along_at(const CardGroom& cards, uint32_t point) {
    if (!cards.ribbons) {
        const glm::uvec4& frame = cards.frames[point];
        return cards.points[frame.y] - cards.points[frame.x];
    }
    const uint32_t before = cards.parameters[point] > 0 ? point - 3 : point;
    const uint32_t after = cards.parameters[point] < 65535 ? point + 3 : point;
    return cards.points[after] - cards.points[before];
}

/// In the world what is `strands` in the frame of an orthonormal row.
StrandArea in_world(const StrandArea& strands, const glm::vec3& across, const glm::vec3& along) {
    const glm::mat3 frame(across, along, glm::cross(across, along));
    const glm::vec3 d = strands.diagonal;
    const glm::vec3 b = strands.beside;
    const glm::mat3 m =
        frame * glm::mat3(d.x, b.x, b.z, b.x, d.y, b.y, b.z, b.y, d.z) * glm::transpose(frame);
    return {{m[0][0], m[1][1], m[2][2]}, {m[0][1], m[1][2], m[2][0]}};
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : otherwise;
}

/// Where the strands of the row of `point` lead, of area 1.
StrandArea strands_at(const CardGroom& cards, const std::vector<StrandArea>& rows, uint32_t point) {
    const glm::vec3 along = unit_or(along_at(cards, point), {0, 1, 0});
    if (rows.empty()) return area_along(along, 1.0f);
    const uint32_t left = point - point % 3;
    const glm::vec3 wide = cards.points[left + 1] - cards.points[left];
    const glm::vec3 across = unit_or(wide - glm::dot(wide, along) * along, {1, 0, 0});
    return in_world(rows[point / 3], across, along);
}

Facet facet_of(const CardGroom& cards, const std::vector<StrandArea>& rows,
               const glm::uvec3& triangle, float piece) {
    Facet facet;
    float longest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<size_t>(k);
        facet.points[i] = cards.points[triangle[k]];
        facet.uvs[i] = cards.uvs[triangle[k]];
        facet.strands += strands_at(cards, rows, triangle[k]).scaled(1.0f / 3.0f);
        longest =
            std::max(longest, glm::distance(facet.points[i], cards.points[triangle[(k + 1) % 3]]));
    }
    facet.parts = std::clamp(static_cast<int>(std::ceil(longest / piece)), 1, kMostParts);
    return facet;
}

void add_facet(const CardAtlas& atlas, const Facet& facet, glm::vec3* at, StrandArea* strands) {
    const glm::vec3 normal =
        glm::cross(facet.points[1] - facet.points[0], facet.points[2] - facet.points[0]);
    const float each = 0.5f * glm::length(normal) / static_cast<float>(facet.parts * facet.parts);
    StrandArea* const begin = strands;
    float mean = 0.0f;
    for (int i = 0; i < facet.parts; ++i) {
        for (int j = 0; j < 2 * (facet.parts - i) - 1; ++j) {
            const float c = mean_strands(atlas, facet, i, j);
            mean += c / static_cast<float>(facet.parts * facet.parts);
            *at++ = blend(facet.points, facet.weights(i, j, glm::vec2(1.0f / 3.0f)));
            *strands++ = facet.strands.scaled(c * each);
        }
    }
    if (mean <= 0.0f || !atlas.fibres.empty()) return;
    // Strands that overlap by chance: of their area a share of (1 - e^-x) / x stays visible. Parts
    // see too few strands to tell x from what they cover.
    const float c = std::min(mean, kMostCover);
    const float more = -std::log(1.0f - c) / c;
    std::for_each(begin, strands, [&](StrandArea& part) { part = part.scaled(more); });
}

}  // namespace

AmbientPieces card_pieces(const CardGroom& cards) {
    const glm::vec3 size = bounds_of(cards).size();
    const float piece = std::max(std::max({size.x, size.y, size.z}) / kPiecesAcross, 1e-6f);
    const auto rows = cards.ribbons ? row_directions(cards) : std::vector<StrandArea>();
    std::vector<Facet> facets;
    std::vector<size_t> begin = {0};
    for (const glm::uvec3& triangle : cards.triangles) {
        facets.push_back(facet_of(cards, rows, triangle, piece));
        const auto parts = static_cast<size_t>(facets.back().parts);
        begin.push_back(begin.back() + parts * parts);
    }
    AmbientPieces pieces;
    pieces.at.resize(begin.back());
    pieces.strands.resize(begin.back());
    parallel_ranges(facets.size(), 64, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            add_facet(cards.atlas, facets[i], &pieces.at[begin[i]], &pieces.strands[begin[i]]);
        }
    });
    return pieces;
}

}  // namespace vellus::hair
