// Longitudinal lobes M of the energy-conserving model (d'Eon et al. 2011, eq. 7), all three at once:
// M = I0e(x) e^(-d²/2v) / (v (1 - e^(-2/v))), x = cos θi cos θr / v, d the chord between the directions'
// meridian points; I0e(x) = e^(-x) I0(x) never overflows. ∫ M cos θi dθi = 1. Tiers differ in I0e alone.
// Domain: v in [1e-6, 16]; sines in [-1, 1], cosines in [0, 1].
#ifndef VELLUS_HAIR_LONGITUDINAL_GLSL
#define VELLUS_HAIR_LONGITUDINAL_GLSL
#include "hair/scattering/fibre.glsl"

const int kLongitudinalGaussian = 0;  // Karis: Gaussian in sin θi + sin θr
const int kLongitudinalA2 = 1;        // I0e within 2.4 %
const int kLongitudinalB = 2;         // I0e within 0.25 %
const int kLongitudinalExact = 3;     // I0e within 1e-6

/// I0e(x) ≈ √(Q/P) for x >= 0, within 2.4 %.
VELLUS_FN vec3 bessel_i0e_a2(vec3 x) {
    vec3 q = vec3(1.0f) + 1.09312391f * x;
    vec3 p = vec3(1.0f) + x * (vec3(2.20000991f) + 6.86829f * x);
    return sqrt(q / p);
}

/// I0e(x) ≈ √(Q/P) for x >= 0, within 0.25 %.
VELLUS_FN vec3 bessel_i0e_b(vec3 x) {
    vec3 q = vec3(1.0f) + x * (vec3(0.38645747f) + 0.57132896f * x);
    vec3 p = vec3(1.0f) + x * (vec3(2.5190982f) + x * (vec3(1.95300827f) + 3.589766f * x));
    return sqrt(q / p);
}

/// I0e(x) for x >= 0: Abramowitz and Stegun 9.8.1 and 9.8.2, within 5e-7. Both sides of x = 3.75 are
/// computed and one is taken.
VELLUS_FN vec3 bessel_i0e_exact(vec3 x) {
    vec3 least = min(x, vec3(3.75f));
    vec3 t = least * least * square(1.0f / 3.75f);
    vec3 low = vec3(0.0360768f) + t * 0.0045813f;
    low = vec3(1.2067492f) + t * (vec3(0.2659732f) + t * low);
    low = vec3(1.0f) + t * (vec3(3.5156229f) + t * (vec3(3.0899424f) + t * low));
    low *= exp2(-kLog2E * least);
    vec3 most = max(x, vec3(3.75f));
    vec3 w = 3.75f / most;
    vec3 high = vec3(-0.01647633f) + w * 0.00392377f;
    high = vec3(-0.02057706f) + w * (vec3(0.02635537f) + w * high);
    high = vec3(-0.00157565f) + w * (vec3(0.00916281f) + w * high);
    high = vec3(0.39894228f) + w * (vec3(0.01328592f) + w * (vec3(0.00225319f) + w * high));
    high *= inversesqrt(most);
    return mix(low, high, step(vec3(3.75f), x));
}

/// M of R, TT and TRT for a light at inclination (sin_i, cos_i).
VELLUS_FN vec3 longitudinal(int tier, VELLUS_IN(HairFibre) fibre, HairEye e, float sin_i, float cos_i) {
    vec3 along = e.sine + vec3(sin_i);
    if (tier == kLongitudinalGaussian) {
        vec3 exponent = along * along * fibre.inverse_v;
        return exp2(-0.5f * kLog2E * exponent) * sqrt(fibre.inverse_v) * 0.398942280f;
    }
    vec3 across = e.cosine - vec3(cos_i);
    vec3 exponent = (along * along + across * across) * fibre.inverse_v;
    vec3 x = cos_i * e.cosine * fibre.inverse_v;
    vec3 bessel;
    if (tier == kLongitudinalA2) {
        bessel = bessel_i0e_a2(x);
    } else if (tier == kLongitudinalB) {
        bessel = bessel_i0e_b(x);
    } else {
        bessel = bessel_i0e_exact(x);
    }
    return exp2(-0.5f * kLog2E * exponent) * bessel * fibre.peak;
}

#endif
