// d'Eon et al. 2011 with N_p integrated in the shader: what the series of azimuthal.glsl approximates, and
// as slow as that sounds. Checked against modules/hair/reference/deon.h.
#ifndef VELLUS_HAIR_DEON_GLSL
#define VELLUS_HAIR_DEON_GLSL
#include "hair/scattering/longitudinal.glsl"

const int kDeonNodes = 32;  // in γi over [0, 90°]; the other half mirrors Φ

/// Gaussian of this deviation on the circle for φ in [-2π, 2π]; < 1e-4 of its peak is left out for
/// deviations up to 0.7.
VELLUS_FN float circular_gaussian(float phi, float width) {
    float x = abs(phi) > kPi ? abs(phi) - 2.0f * kPi : abs(phi);
    float y = 2.0f * kPi - abs(x);
    float scale = -0.5f * kLog2E / (width * width);
    return (exp2(scale * x * x) + exp2(scale * y * y)) * (0.398942280f / width);
}

/// N_TT and N_TRT at cos θd and φ in [0, π], midpoint rule in γi: the integrand falls as cos³ γi at the
/// end, which leaves an error of fourth order.
VELLUS_FN void deon_azimuthal(VELLUS_IN(HairFibre) fibre, vec3 log2_color, float cos_d, float phi,
                              VELLUS_OUT(vec3) tt, VELLUS_OUT(vec3) trt) {
    float cos2_t = 1.0f - (1.0f - cos_d * cos_d) * fibre.inverse_index2;
    float inverse = cos_d * inversesqrt(fibre.index2_1 + cos_d * cos_d);  // 1/η'
    vec3 half_log = log2_color * (0.5f * inversesqrt(cos2_t));
    tt = vec3(0.0f);
    trt = vec3(0.0f);
    for (int i = 0; i < kDeonNodes; ++i) {
        float gamma = (float(i) + 0.5f) * (0.5f * kPi / float(kDeonNodes));
        float cos_i = cos(gamma);
        float sin_t = sin(gamma) * inverse;
        float gamma_t = asin(sin_t);
        float reflected = fresnel_exact(fibre.index2_1, cos_d * cos_i);
        vec3 path = exp2(half_log * sqrt(1.0f - sin_t * sin_t));
        float weight = square(1.0f - reflected) * cos_i;
        float through = 2.0f * gamma_t - 2.0f * gamma + kPi;  // Φ(1, h) in [0, π]
        float back = 4.0f * gamma_t - 2.0f * gamma;           // Φ(2, h) - 2π in [-π, π]
        tt += path * (weight * (circular_gaussian(phi - through, fibre.detector_tt) +
                                circular_gaussian(phi + through, fibre.detector_tt)));
        trt += path * path * (weight * reflected * (circular_gaussian(phi - back, fibre.detector_trt) +
                                                    circular_gaussian(phi + back, fibre.detector_trt)));
    }
    float scale = 0.5f * (0.5f * kPi / float(kDeonNodes));
    tt *= scale;
    trt *= scale;
}

/// S of R + TT + TRT [1/sr].
VELLUS_FN vec3 deon_bsdf(VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, HairEye e,
                         vec3 to_light) {
    HairAngles a = hair_angles(f, to_light);
    vec3 m = longitudinal(kLongitudinalExact, fibre, e, a.sin_i, a.cos_i);
    float r = 0.5f * s.specular * a.cos_half_phi * fresnel_exact(fibre.index2_1, a.cos_d * a.cos_half_phi);
    vec3 tt;
    vec3 trt;
    deon_azimuthal(fibre, hair_log2_color(s.base_color), a.cos_d, acos(clamp(a.cos_phi, -1.0f, 1.0f)), tt,
                   trt);
    return vec3(m.x * r) + m.y * tt + m.z * trt;
}

#endif
