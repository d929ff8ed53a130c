#pragma once

#include "shaders/common/portable.h"

/// The shader's own functions of all scattering techniques, compiled as C++ in float.
namespace vellus::hair::glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "hair/scattering/scattering.glsl"
}  // namespace vellus::hair::glsl

namespace vellus::hair {

/// What the azimuthal lobes depend on; colour and roughness are not among it.
struct FibreOptics {
    float eta = 1.55f;  ///< index of refraction, in [1.1, 3]
    /// Deviations of the azimuthal detectors of TT and TRT, radians, in [0.1, 2]; Karis's.
    float detector_tt = 0.63481f;
    float detector_trt = 0.27207f;
    bool operator==(const FibreOptics&) const = default;
};

/// Fits the series of azimuthal.glsl to d'Eon's lobes, by least squares over cos θd and colour,
/// weighted by the lobe's size: under a millisecond. Leaves the rest of `fibre` alone.
void fit_azimuthal(const FibreOptics& optics, glsl::HairFibre& fibre);

/// The longitudinal part from Karis's roughness and the sine of the cuticle's tilt: deviations r²,
/// r²/2, 2 r² (at least 1e-3), turned by -2, 1, 4 times the tilt. Leaves the series alone.
void set_longitudinal(float roughness, float shift, glsl::HairFibre& fibre);

}  // namespace vellus::hair
