#pragma once

#include <array>
#include <optional>
#include <vector>

#include "modules/hair/grow/guides.h"

namespace vellus::hair::grow {

/// Strands while they take shape: each has `points` points, one strand after the other.
struct Strands {
    size_t points = 0;
    std::vector<glm::vec3> at;

    [[nodiscard]] size_t count() const { return at.size() / points; }
    glm::vec3* strand(size_t i) { return &at[i * points]; }
    [[nodiscard]] const glm::vec3* strand(size_t i) const { return &at[i * points]; }
};

/// The guides next to a root, nearest first, with weights that add up to 1.
struct Neighbours {
    std::array<uint32_t, 3> guide{};
    std::array<double, 3> weight{};
};

/// Guides belong to the first guides.size() roots. Those across the parting or where the skin faces
/// elsewhere count as further away.
std::vector<Neighbours> find_neighbours(const std::vector<Root>& roots,
                                        const std::vector<double>& from_parting,
                                        size_t guide_count);

/// One strand per root, blended from the guides next to it and cut to its own length.
Strands interpolate(const Ground& ground, const std::vector<Root>& roots,
                    const std::vector<Guide>& guides, const std::vector<Neighbours>& neighbours,
                    const std::optional<Gather>& gather);

}  // namespace vellus::hair::grow
