#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "modules/hair/grow/surface.h"

namespace vellus::hair::grow {

/// The nearest point of a surface.
struct Closest {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< smooth, unit, outwards
    double distance = 0.0;             ///< negative inside
    bool found = false;
};

/// Answers which point of a surface is nearest: a bounding volume hierarchy of its triangles.
/// Immutable, so any number of threads may ask.
class ClosestPoint {
  public:
    explicit ClosestPoint(const GrowSurface& surface);

    /// Within `reach` of p; what lies further away is not found.
    [[nodiscard]] Closest operator()(glm::dvec3 p, double reach) const;

    /// p moved out along the normal until it is `clearance` away from the surface; points deeper
    /// than `reach` inside are not noticed.
    [[nodiscard]] glm::dvec3 push_out(glm::dvec3 p, double clearance, double reach) const;

  private:
    struct Node {
        glm::vec3 low;
        glm::vec3 high;
        /// Leaf: first triangle; else the second child (the first one follows its parent).
        uint32_t next = 0;
        uint32_t count = 0;
    };
    struct Triangle {
        glm::dvec3 a, ab, ac;
        uint32_t vertex[3];
    };
    struct Nearest;

    void build(std::span<uint32_t> order, const std::vector<glm::vec3>& centers,
               const GrowSurface& surface);
    static void visit(const Triangle& triangle, uint32_t index, glm::dvec3 p, Nearest& nearest);

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;
    std::vector<glm::vec3> normals_;
};

}  // namespace vellus::hair::grow
