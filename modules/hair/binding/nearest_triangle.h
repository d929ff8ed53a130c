#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace vellus::hair {

/// The point of a mesh nearest to another one.
struct SurfacePoint {
    uint32_t triangle = 0;
    glm::dvec2 barycentric{0.0};  ///< of the triangle's second and third vertex
    double distance = 0.0;
};

/// Nearest point of the triangle a, b, c to p (Ericson, Real-Time Collision Detection, 5.1.5);
/// `triangle` stays 0.
SurfacePoint nearest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                 const glm::dvec3& c);

/// Bounding volume hierarchy over triangles, for nearest points. Triangles without area relative to
/// their length are left out: their neighbours' edges hold the same points.
class TriangleTree {
  public:
    TriangleTree(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles);

    [[nodiscard]] bool empty() const { return order_.empty(); }
    /// Needs a tree that is not empty. Thread-safe.
    [[nodiscard]] SurfacePoint nearest(const glm::dvec3& p) const;

  private:
    struct Node {
        glm::dvec3 low;
        glm::dvec3 high;
        uint32_t first;  ///< triangle in order_, or left child (the right one follows)
        uint32_t count;  ///< 0: an inner node
    };

    void split(uint32_t node, uint32_t first, uint32_t last, uint32_t depth,
               std::span<const glm::dvec3> centers);

    std::span<const glm::dvec3> positions_;
    std::span<const glm::uvec3> triangles_;
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace vellus::hair
