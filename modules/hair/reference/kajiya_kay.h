#pragma once

#include "modules/hair/reference/fibre.h"

namespace vellus::hair::reference {

/// Kajiya and Kay 1989, "Rendering Fur with Three Dimensional Textures", as S [1/sr] per irradiance
/// across the beam: k_d cos θi + k_s cos^p(θi + θr). cos(θi + θr) = sin sin - (T·L)(T·V), both
/// directions away from the fibre; behind 90° the highlight is 0. The diffuse part takes the
/// light's sine with the tangent and is not reciprocal; the highlight is.
struct KajiyaKay {
    double diffuse = 0.0;   ///< k_d
    double specular = 0.0;  ///< k_s
    double exponent = 1.0;  ///< p, > 0
};

/// Parameters from Karis's: the diffuse part alone sends back C of a furnace, k_d = C / π²; the
/// highlight has the deviation r² of R (p = 1/β²), its reflectance F0 and R's azimuthal mean.
KajiyaKay kajiya_kay_parameters(const glsl::HairSurface& surface, int channel);

double kajiya_kay(const KajiyaKay& parameters, double theta_i, double theta_r);

}  // namespace vellus::hair::reference
