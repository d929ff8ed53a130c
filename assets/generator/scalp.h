#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace vellus::sculpt {

/// Where a hair grows.
struct Root {
    glm::dvec3 position;
    glm::dvec3 normal;
    /// Along the scalp, where the comb pulls.
    glm::dvec3 comb;
    /// Metres from the parting, along x; its sign is the side.
    double from_parting;
};

/// Roots along some two thirds of `directions`, spread evenly below the hairline and closer
/// together beside the parting.
std::vector<Root> make_roots(uint32_t directions);

}  // namespace vellus::sculpt
