#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "assets/generator/surface_nets.h"

namespace vellus::sculpt {

/// Collapses edges of a closed manifold until at most `triangles` are left, those first that move
/// the surface least (quadric error metrics, Garland and Heckbert 1997) and join like `colors` (one
/// per vertex). The result stays closed and manifold; its normals are left empty.
Surface decimate(const Surface& surface, const std::vector<glm::dvec3>& colors, size_t triangles);

}  // namespace vellus::sculpt
