#pragma once

#include "assets/generator/part.h"

namespace vellus::sculpt {

/// Height and colour of a lawn with a round path of this radius around the origin, and low hills
/// far out.
struct Ground {
    double path_radius = 0.0;
    double path_width = 1.3;
    /// Where the lawn ends, in metres from the origin.
    double reach = 70.0;
    /// Where the scene has the origin.
    glm::dvec3 center{0.0};
};

/// Metres; 0 on the path and near it.
double ground_height(const Ground& ground, double x, double z);

/// Rings around the origin, close together at the path, wide apart outside; some 4,000 triangles.
SkinnedPart make_ground(const Ground& ground);

}  // namespace vellus::sculpt
