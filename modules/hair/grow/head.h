#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "modules/hair/grow/roots.h"
#include "modules/hair/grow/settings.h"

namespace vellus::hair::grow {

/// The ball that fits the scalp best: left +X of it, crown up, face towards +Z. Styles are drawn
/// relative to it.
struct Head {
    glm::dvec3 center{0.0};
    double radius = 0.09;
};

/// Where hair whirls, in radii from the middle of the head.
constexpr glm::dvec3 kCrown{0.10, 0.93, -0.45};

/// The least-squares sphere through the roots; where they are too flat or too few for one, a ball
/// as large as they are spread.
Head fit_head(const std::vector<Root>& roots);

/// How far a point of the scalp is from the parting, in radii: its sign is the side. The parting
/// runs back from the forehead, not quite straight, and bends to the crown.
double from_parting(const Head& head, const GrowSettings& settings, glm::dvec3 position);

/// Which way the comb goes at a point of the scalp, along the skin, unit; and how far it is from
/// the parting, in radii: its sign is the side.
struct Combed {
    glm::dvec3 direction{0.0};
    double from_parting = 0.0;
};
Combed comb(const Head& head, const GrowSettings& settings, const Root& root);

/// Distance to the space before the face that hair keeps out of: an upright oval, open to the
/// front, which pushes sideways and never forwards. Negative inside.
double face_distance(const Head& head, glm::dvec3 p);

/// p moved out of the face by `clearance`.
glm::dvec3 clear_of_face(const Head& head, glm::dvec3 p, double clearance);

}  // namespace vellus::hair::grow
