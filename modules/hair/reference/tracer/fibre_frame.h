#pragma once

#include "modules/hair/reference/chiang.h"
#include "modules/hair/reference/tracer/geometry.h"

namespace vellus::hair::tracer {

/// Axes at a point of a strand: tangent, the eye's azimuth, and what is a quarter turn on.
struct FibreFrame {
    glm::dvec3 tangent{0.0};
    glm::dvec3 towards{0.0};  ///< across the fibre, to the eye
    glm::dvec3 aside{0.0};
    reference::Inclination eye;
    double h = 0.0;  ///< offset from the axis, see reference::ChiangScattering

    [[nodiscard]] reference::Inclination inclination(const glm::dvec3& direction) const;
    [[nodiscard]] double azimuth(const glm::dvec3& direction) const;
    [[nodiscard]] glm::dvec3 direction(reference::Inclination i, double azimuth) const;
};

/// From the smooth tangent there and the geometric normal; `to_eye` is unit.
FibreFrame fibre_frame(const glm::dvec3& tangent, const glm::dvec3& normal,
                       const glm::dvec3& to_eye);

/// What hair_sample() and hair_color() of geometry/instance.glsl give for a point of a segment.
struct StrandPoint {
    glm::dvec3 tangent{0.0};
    glm::dvec3 color{0.0};
    double radius = 0.0;
};
StrandPoint strand_point(const Groom& groom, uint32_t segment, double at);

}  // namespace vellus::hair::tracer
