// The scattering axis: one function for all techniques, chosen by a constant so that only one is left in a
// pipeline. Ids as modules/hair/techniques.h.
#ifndef VELLUS_HAIR_SCATTERING_GLSL
#define VELLUS_HAIR_SCATTERING_GLSL
#include "hair/scattering/azimuthal.glsl"
#include "hair/scattering/deon.glsl"
#include "hair/scattering/dual.glsl"
#include "hair/scattering/kajiya_kay.glsl"
#include "hair/scattering/longitudinal.glsl"
#include "hair/scattering/marschner.glsl"

const int kScatteringKaris = 0;
const int kScatteringKajiyaKay = 1;
const int kScatteringMarschner = 2;
const int kScatteringKarisRational = 3;  // Karis's N, M of tier B
const int kScatteringSeriesGaussian = 4;
const int kScatteringSeriesA2 = 5;
const int kScatteringSeriesB = 6;
const int kScatteringSeriesExact = 7;
const int kScatteringDeon = 8;
const int kScatteringCount = 9;

const int kMultipleNone = 0;
const int kMultipleFakeNormal = 1;
const int kMultipleDual = 2;

/// S of single scattering [1/sr] for a beam from `to_light` (unit). karis and kajiya_kay use neither
/// `fibre` nor `e`. A technique from outside the module (modules/hair/ADD_A_TECHNIQUE.md) defines the macro
/// VELLUS_HAIR_BSDF(fibre, s, f, e, to_light) in its own stage and is alone there.
VELLUS_FN vec3 hair_bsdf(int technique, VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, HairEye e,
                         vec3 to_light) {
#ifdef VELLUS_HAIR_BSDF
    return VELLUS_HAIR_BSDF(fibre, s, f, e, to_light);
#else
    if (technique == kScatteringKaris) return karis_bsdf(s, f, to_light);
    if (technique == kScatteringKajiyaKay) return kajiya_kay_bsdf(s, f, to_light);
    if (technique == kScatteringMarschner) return marschner_bsdf(fibre, s, f, to_light);
    if (technique == kScatteringDeon) return deon_bsdf(fibre, s, f, e, to_light);
    if (technique == kScatteringKarisRational) {
        return karis_tier_bsdf(kLongitudinalB, fibre, s, f, e, to_light);
    }
    return series_bsdf(technique - kScatteringSeriesGaussian, fibre, s, f, e, to_light);
#endif
}

/// Radiance to the eye per unit irradiance across the beam; `shadow` in [0, 1] is the light that passes the
/// hair in front (1 = lit), `behind` the optical depth of the hair behind, for dual scattering.
VELLUS_FN vec3 hair_direct(int technique, int multiple, VELLUS_IN(HairFibre) fibre, HairSurface s,
                           HairFrame f, HairEye e, vec3 to_light, float shadow, float behind) {
    vec3 scattered = hair_bsdf(technique, fibre, s, f, e, to_light);
    if (multiple == kMultipleFakeNormal) {
        float sin_i = clamp(dot(f.tangent, to_light), -1.0f, 1.0f);
        scattered += karis_scattering(s, f, to_light, shadow) * safe_sqrt(1.0f - sin_i * sin_i);
    }
    vec3 radiance = scattered * shadow;
    if (multiple == kMultipleDual) radiance += dual_scattering(fibre, s, f, e, to_light, shadow, behind);
    return radiance;
}

#endif
