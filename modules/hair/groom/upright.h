#pragma once

#include <glm/glm.hpp>
#include <string>

#include "modules/hair/groom/groom.h"

namespace vellus::hair {

/// How a groom's own coordinates become metres, Y up, face towards +Z: a rotation times a scale, no
/// translation, so a groom stays where its file puts it relative to its head.
struct Upright {
    glm::dmat4 to_metres{1.0};
    double metres_per_unit = 1.0;
    /// Where hair grows, after the transform.
    glm::dvec3 scalp_low{0.0};
    glm::dvec3 scalp_high{0.0};
    /// Box of the hair after the transform.
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    /// One line for people: up axis, unit and front, each with its reason.
    std::string reason;
};

/// Up axis: the format's (.hair Z, .tfx and glTF Y) unless the hair clearly hangs along another
/// one. Unit: the format's (.hair centimetre, others metre) unless the scalp would be no human's,
/// then the scalp is made 0.17 m. Front: where the hairline is highest (.hair only; others already
/// face +Z).
Upright upright_transform(const Groom& groom);

/// Strand diameter in metres after `to_metres`: the file's mean thickness where it gives one,
/// within [kThinnestStrand, kThickestStrand]; else so that strands side by side cover the hair's
/// silhouette eight times (few strands are drawn thicker), within [0.06, 1.5] mm.
double default_width(const Groom& groom, double metres_per_unit);

}  // namespace vellus::hair
