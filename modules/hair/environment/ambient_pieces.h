#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace vellus::hair {

struct CardGroom;

/// Of some strands the sum of a·t·tᵀ, a their area (length times width) and t where they point.
struct StrandArea {
    glm::vec3 diagonal{0.0f};
    glm::vec3 beside{0.0f};  ///< xy, yz, zx

    StrandArea& operator+=(const StrandArea& other) {
        diagonal += other.diagonal;
        beside += other.beside;
        return *this;
    }
    [[nodiscard]] StrandArea scaled(float s) const { return {s * diagonal, s * beside}; }
    /// Area seen along unit direction `d`: exact for parallel strands; for those that point
    /// anywhere √(2/3), not π/4, of their area.
    [[nodiscard]] float seen(const glm::vec3& d) const {
        const float whole = diagonal.x + diagonal.y + diagonal.z;
        const float along =
            glm::dot(diagonal, d * d) + 2.0f * glm::dot(beside, d * glm::vec3(d.y, d.z, d.x));
        return std::sqrt(std::max(whole * (whole - along), 0.0f));
    }
};

/// Of parallel strands along unit direction `t`.
inline StrandArea area_along(const glm::vec3& t, float area) {
    return {area * t * t, area * t * glm::vec3(t.y, t.z, t.x)};
}

/// Strands of a groom in pieces that are small beside it, in square metres.
struct AmbientPieces {
    std::vector<glm::vec3> at;
    std::vector<StrandArea> strands;
};

/// The strands that cards show: pieces of triangles, whose strands lie anywhere in them and
/// together cover what the atlas says. Strands of a ribbon point where its rows say
/// (row_directions.h), those of other cards along them.
AmbientPieces card_pieces(const CardGroom& cards);

}  // namespace vellus::hair
