#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace vellus::sculpt {

/// A closed surface: triangles counter-clockwise seen from outside.
struct Surface {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<uint32_t> indices;
};

/// Grid lines along each axis, increasing; the field must be positive on the outermost ones.
struct Grid {
    std::vector<double> x, y, z;
};

/// Where grid lines are this far apart: up to `end`, from the end of the stretch before.
struct Stretch {
    double end;
    double spacing;
};

/// Lines from `begin` on, evenly spaced in every stretch.
std::vector<double> grid_lines(double begin, const std::vector<Stretch>& stretches);

using Field = std::function<double(glm::dvec3)>;

/// The surface field = 0: one vertex in each cell it crosses, one quad over each edge (surface
/// nets, Gibson 1998); normals are left empty.
Surface surface_nets(const Grid& grid, const Field& field);

/// Moves vertices onto field = 0, none further than half its shortest edge, and takes the field's
/// gradients as normals.
void settle(Surface& surface, const Field& field);

}  // namespace vellus::sculpt
