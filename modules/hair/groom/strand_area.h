#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace vellus::hair {

/// Of some strands the sum of a·t·tᵀ, a their area (length times width) and t where they point.
struct StrandArea {
    glm::vec3 diagonal{0.0f};
    glm::vec3 beside{0.0f};  ///< xy, yz, zx

    StrandArea& operator+=(const StrandArea& other) {
        diagonal += other.diagonal;
        beside += other.beside;
        return *this;
    }
    [[nodiscard]] float whole() const { return diagonal.x + diagonal.y + diagonal.z; }
    [[nodiscard]] StrandArea scaled(float s) const { return {s * diagonal, s * beside}; }
    /// Area seen along unit direction `d`: exact for parallel strands; for those that point
    /// anywhere √(2/3), not π/4, of their area.
    [[nodiscard]] float seen(const glm::vec3& d) const {
        // The whole less what hides along d, term by term: parallel strands cancel exactly.
        const float across = glm::dot(diagonal, 1.0f - d * d) -
                             2.0f * glm::dot(beside, d * glm::vec3(d.y, d.z, d.x));
        return std::sqrt(std::max(whole() * across, 0.0f));
    }
};

/// Of parallel strands along unit direction `t`.
inline StrandArea area_along(const glm::vec3& t, float area) {
    return {area * t * t, area * t * glm::vec3(t.y, t.z, t.x)};
}

}  // namespace vellus::hair
