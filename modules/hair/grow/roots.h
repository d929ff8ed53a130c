#pragma once

#include <vector>

#include "modules/hair/grow/surface.h"

namespace vellus::hair::grow {

/// Where a hair grows.
struct Root {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};
    glm::vec2 uv{0.0f};
    uint32_t triangle = 0;
};

/// `count` roots spread over the haired area in proportion to its density, none close to another
/// (a Poisson-disk set), in an order of which every beginning is spread evenly too. Fewer only
/// where the surface has no area.
std::vector<Root> scatter_roots(const GrowSurface& surface, uint32_t count, uint32_t seed);

}  // namespace vellus::hair::grow
