#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/ecs/ecs.h"

namespace vellus::demo {

/// What a character can stand on: all triangles of the scene's rigid meshes, in the world.
class Ground {
  public:
    Ground() = default;
    explicit Ground(World& world);

    /// The highest surface at (x, z) that is not above `highest`; none where there is no surface.
    [[nodiscard]] std::optional<double> height(double x, double z, double highest) const;
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        triangles_.push_back({a, b, c});
    }

  private:
    std::vector<std::array<glm::dvec3, 3>> triangles_;
};

}  // namespace vellus::demo
