#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "assets/generator/surface_nets.h"

namespace vellus::sculpt {

/// An eye of the bust's size, looking along +Z.
struct Eyeball {
    Surface surface;
    /// Linear, one per vertex.
    std::vector<glm::dvec3> colors;
};

/// A sphere of rings around the optical axis, at these distances from it (metres, increasing), then
/// two behind; `sides` is a power of two.
Eyeball make_eyeball(glm::dvec3 center, double radius, int sides, std::span<const double> rings);

}  // namespace vellus::sculpt
