#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "modules/hair/groom/groom.h"

namespace vellus::hair {

/// A body with its scalp: hair grows where `density` is above 0 and stays outside all of it.
/// Metres, Y up, looking along +Z.
struct GrowSurface {
    std::vector<glm::vec3> positions;
    /// Unit, outwards, one per vertex.
    std::vector<glm::vec3> normals;
    /// One per vertex, or empty.
    std::vector<glm::vec2> uvs;
    /// Counter-clockwise seen from outside, three indices each.
    std::vector<uint32_t> triangles;
    /// Share of the full number of hairs, 0 to 1, one per vertex.
    std::vector<float> density;
    /// A further factor, 0 to 1, at any point of the surface, for what vertices are too coarse to
    /// say; may be empty. Called by several threads.
    std::function<float(glm::vec3 position, glm::vec2 uv)> mask;
    /// From this space to that of the mesh's POSITION attribute.
    glm::dmat4 to_mesh{1.0};

    [[nodiscard]] size_t triangle_count() const { return triangles.size() / 3; }
};

/// A ball that is haired where a person's head would be: above the brow, further down behind.
/// `whole`: everywhere.
GrowSurface sphere_surface(glm::vec3 center, float radius, bool whole);

/// Area of triangle `triangle` in square metres times the mean of density and mask.
double haired_area(const GrowSurface& surface, size_t triangle);
/// The sum over all triangles.
double haired_area(const GrowSurface& surface);

/// Density times mask at the point with these barycentric weights of the second and third corner.
double density_at(const GrowSurface& surface, size_t triangle, double u, double v);

}  // namespace vellus::hair
