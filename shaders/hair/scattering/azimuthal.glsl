// Azimuthal lobes N_p of d'Eon et al. 2011 as short cosine series whose coefficients are polynomials:
// N_p = ½ ∫ A(p, h) D_p(φ - Φ(p, h)) dh = c_0 + 2 Σ c_k cos kφ, where a Gaussian detector of width b
// damps c_k by e^(-k²b²/2), so that few are left. Absorption leaves the integral by interpolating in the
// path's length: e^(-2pσ cos γt / cos θt) ≈ Σ_j w_j e^(-2pσ m_j / cos θt) with two fixed m_j (TT), one (TRT).
// Each c_k is then u² times a quadratic in u = x / (x + ½), x = cos θd, which straightens Fresnel's
// transmittance (1 - F)² ~ x² near grazing. All coefficients are fitted on the CPU for any η and b.
#ifndef VELLUS_HAIR_AZIMUTHAL_GLSL
#define VELLUS_HAIR_AZIMUTHAL_GLSL
#include "hair/scattering/longitudinal.glsl"

const float kPathShort = 0.80f;  // m_j, in diameters
const float kPathLong = 0.97f;
const float kGrazing = 0.5f;

/// Unit-colour azimuthal lobes: TT over the short and the long path, and TRT; may dip below 0 slightly.
struct HairAzimuthal {
    float tt_short;
    float tt_long;
    float trt;
};

VELLUS_FN HairAzimuthal hair_azimuthal(VELLUS_IN(HairFibre) fibre, float cos_d, float cos_phi) {
    float u = cos_d / (cos_d + kGrazing);
    // cos kφ by Chebyshev's recurrence; the factor 2 of the series is in the coefficients.
    float c2 = 2.0f * cos_phi * cos_phi - 1.0f;
    float c3 = 2.0f * cos_phi * c2 - cos_phi;
    float c4 = 2.0f * cos_phi * c3 - c2;
    float c5 = 2.0f * cos_phi * c4 - c3;
    float c6 = 2.0f * cos_phi * c5 - c4;
    float c7 = 2.0f * cos_phi * c6 - c5;
    vec4 low = vec4(1.0f, cos_phi, c2, c3);
    vec4 high = vec4(c4, c5, c6, c7);
    HairAzimuthal n;
    float u2 = u * u;
    n.tt_short = u2 * dot(fibre.tt[0] + u * (fibre.tt[1] + u * fibre.tt[2]), low);
    n.tt_long = u2 * dot(fibre.tt[3] + u * (fibre.tt[4] + u * fibre.tt[5]), low);
    n.trt = u2 * (dot(fibre.trt[0] + u * (fibre.trt[1] + u * fibre.trt[2]), low) +
                  dot(fibre.trt[3] + u * (fibre.trt[4] + u * fibre.trt[5]), high));
    return n;
}

/// S of R + TT + TRT [1/sr]: M in the given tier, R exact, TT and TRT by the series. `log2_color` as
/// hair_log2_color; C = e^(-4 σ_a).
VELLUS_FN vec3 series_bsdf(int tier, VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, HairEye e,
                           vec3 to_light) {
    HairAngles a = hair_angles(f, to_light);
    vec3 m = longitudinal(tier, fibre, e, a.sin_i, a.cos_i);
    float r = 0.5f * s.specular * a.cos_half_phi * fresnel_exact(fibre.index2_1, a.cos_d * a.cos_half_phi);
    HairAzimuthal n = hair_azimuthal(fibre, a.cos_d, a.cos_phi);
    // cos θt of the refracted inclination; C^(m/2) is a diameter at m = 1.
    float cos2_t = 1.0f - (1.0f - a.cos_d * a.cos_d) * fibre.inverse_index2;
    vec3 half_log = hair_log2_color(s.base_color) * (0.5f * inversesqrt(cos2_t));
    vec3 path_short = exp2(half_log * kPathShort);
    vec3 path_long = exp2(half_log * kPathLong);
    vec3 tt = max(path_short * n.tt_short + path_long * n.tt_long, vec3(0.0f));
    // TRT's single path is twice the mean of the two: their product.
    vec3 trt = path_short * path_long * max(n.trt, 0.0f);
    return vec3(m.x * r) + m.y * tt + m.z * trt;
}

/// The same M with Karis's azimuthal fits.
VELLUS_FN vec3 karis_tier_bsdf(int tier, VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f,
                               HairEye e, vec3 to_light) {
    HairAngles a = hair_angles(f, to_light);
    vec3 m = longitudinal(tier, fibre, e, a.sin_i, a.cos_i);
    vec3 log2_color = hair_log2_color(s.base_color);
    float r = 0.5f * s.specular * a.cos_half_phi * hair_fresnel(a.cos_d * a.cos_half_phi);
    return vec3(m.x * r) +
           m.y * karis_tt_azimuthal(log2_color, 0.0f, a.cos_d, a.cos_phi, a.cos_half_phi) +
           m.z * karis_trt_azimuthal(log2_color, 0.0f, a.cos_d, a.cos_phi);
}

#endif
