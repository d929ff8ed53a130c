#pragma once

#include <glm/glm.hpp>

#include "modules/hair/scattering/karis.h"

namespace vellus::hair::reference {

/// The terms of Karis's slides in double, [1/sr]; ∫ (R + TT + TRT) dω_i is the albedo.
struct KarisTerms {
    glm::dvec3 r;
    glm::dvec3 tt;
    glm::dvec3 trt;
    glm::dvec3 scattering;

    [[nodiscard]] glm::dvec3 bsdf() const { return r + tt + trt; }
};

/// What the environment changes (slides, "Environment lighting").
struct KarisVariant {
    double added_beta = 0.0;
    bool with_tt = true;
    bool occlude_r = false;
};

/// B. Karis 2016 as printed, in angles, with inverse trigonometry, for directions that are not
/// parallel to the tangent. Where the slides are silent or wrong it follows
/// shaders/hair/scattering/karis.glsl: azimuthal R with the tilt -shift, 1 - h² clamped to 0,
/// specular 0.5 = physical, black's tint 1.
KarisTerms karis_terms(const glsl::HairSurface& surface, const glm::dvec3& tangent,
                       const glm::dvec3& to_light, const glm::dvec3& to_view, double shadow,
                       const KarisVariant& variant = {});

}  // namespace vellus::hair::reference
