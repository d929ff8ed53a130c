// Single scattering and the fake-normal scattering term of a hair fibre.
// Source: B. Karis, "Physically Based Hair Shading in Unreal", SIGGRAPH 2016; lobes after Marschner et al.
// 2003 and d'Eon et al. 2011; azimuthal R after d'Eon et al. 2014; absorption after Pekelis et al. 2015.
//
// Angles: θ is the inclination from the fibre's normal plane, sin θ = ω·u; u runs from root to tip; both
// directions leave the fibre; φ = 0 scatters back, φ = π goes straight through.
// Units: S = Σ M_p N_p [1/sr] with d'Eon's normalisation, ∫ M cos θi dθi = 1: the fibre's cosine is in M
// already, so a beam of irradiance E (measured across the beam) sends S E to the eye, and ∫ S dω_i is the
// albedo. The scattering term is a plain phase function and takes cos θi E, what falls on the fibre.
// Domain: directions of unit length (or zero); base_color in [0, 1], the rest as beside each field.
// Everything is finite, not negative and continuous there; no inverse trigonometry.
#ifndef VELLUS_HAIR_KARIS_GLSL
#define VELLUS_HAIR_KARIS_GLSL
#include "common/portable.glsl"

struct HairSurface {
    vec3 base_color;  // C, linear, [0, 1]
    float specular;   // scales R, [0, 1]; 0.5 is the physical reflection of η = 1.55
    float roughness;  // [0, 1]: β_R = r², β_TT = r²/2, β_TRT = 2 r²; β is kept >= 1e-3
    float scatter;    // scales the fake-normal term, >= 0
    float shift;      // sine of the cuticle's tilt, about 0.035 for human hair, [-0.2, 0.2]
};

/// What the lobes need of the fibre and the eye; shared by all lights of a pixel.
struct HairFrame {
    vec3 tangent;
    vec3 normal;  // fake normal: ω_r without its part along u; see hair_frame
    float fade;   // 1 - |normal|²
    float sin_r;
    float cos_r;
};

/// A light path's angles, by sines, cosines and chords; no inverse trigonometry.
struct HairAngles {
    float sin_i;
    float cos_i;
    float cos_half_phi;  // >= 0
    float cos_phi;
    float cos_d;  // of half the difference of the inclinations
};

const float kHairMinBeta = 1.0e-3f;  // v = β² >= 1e-6
const float kHairMinCosD = 1.0e-4f;
const float kHairDegenerate = 1.0e-7f;  // cos² of the inclination where the azimuth fades out
const float kHairMinColor = 1.0e-37f;   // smallest colour that log2 sees; its TT is below 1e-13

/// `tangent` from root to tip and `to_view`, both unit. At ω_r ∥ u no perpendicular is better than
/// another, and any fixed one would depend on the world's axes and jump: there the fake normal shrinks
/// to zero length instead (within about 3e-4 rad), the mean of all of them.
VELLUS_FN HairFrame hair_frame(vec3 tangent, vec3 to_view) {
    HairFrame f;
    f.tangent = tangent;
    f.sin_r = clamp(dot(tangent, to_view), -1.0f, 1.0f);
    vec3 across = to_view - f.sin_r * tangent;
    float cos2 = dot(across, across);
    float scale = inversesqrt(cos2 + kHairDegenerate);
    f.normal = across * scale;
    f.fade = kHairDegenerate * scale * scale;
    f.cos_r = min(sqrt(cos2), 1.0f);
    return f;
}

/// Angles of a path from `to_light` (unit) to the eye.
VELLUS_FN HairAngles hair_angles(HairFrame f, vec3 to_light) {
    HairAngles a;
    a.sin_i = clamp(dot(f.tangent, to_light), -1.0f, 1.0f);
    vec3 across = to_light - a.sin_i * f.tangent;
    float cos2 = dot(across, across);
    a.cos_i = min(sqrt(cos2), 1.0f);
    // cos² φ/2 by the chord of the two azimuths, exact near φ = π where R is narrow; where an azimuth has
    // faded away φ tends to 90°.
    float scale = inversesqrt(cos2 + kHairDegenerate);
    vec3 chord = across * scale + f.normal;
    float half_phi2 =
        min(0.25f * (dot(chord, chord) + f.fade + kHairDegenerate * scale * scale), 1.0f);
    a.cos_half_phi = sqrt(half_phi2);
    a.cos_phi = 2.0f * half_phi2 - 1.0f;
    // cos θd = cos ((θr - θi) / 2), by the chord of the two inclinations.
    a.cos_d = min(0.5f * sqrt(square(a.cos_i + f.cos_r) + square(a.sin_i + f.sin_r)), 1.0f);
    return a;
}

/// Schlick's Fresnel reflectance at η = 1.55.
VELLUS_FN float hair_fresnel(float cosine) {
    float k = 1.0f - min(cosine, 1.0f);
    float k2 = k * k;
    return 0.04652057f + 0.95347943f * k2 * k2 * k;
}

VELLUS_FN vec3 hair_log2_color(vec3 c) { return log2(max(c, vec3(kHairMinColor))); }

/// M_R N_R (slides, "Azimuthal R"): width β√2 cos φ/2 and the shift of d'Eon 2014 for the tilt -shift, so
/// that α_R = -2 shift at φ = 0. The cos φ/2 of N cancels the one in M's normalisation; at φ = π, where
/// the width is 0, the lobe fades to 0.
VELLUS_FN float karis_r(HairSurface s, HairFrame f, float sin_i, float cos_i, float cos_half_phi,
                        float added_beta) {
    float beta = max(s.roughness * s.roughness, kHairMinBeta) + added_beta;
    float tilt_cos = safe_sqrt(1.0f - s.shift * s.shift);
    float shift =
        -2.0f * s.shift * (tilt_cos * cos_half_phi * f.cos_r - s.shift * f.sin_r);
    float x = sin_i + f.sin_r - shift;
    float c2 = cos_half_phi * cos_half_phi;
    float width2 = c2 + 1.0e-5f;
    float lobe = exp2(-0.25f * kLog2E * x * x / (beta * beta * width2)) * c2 / width2;
    // Cosine of the half angle between the directions, by their chord: ¼|ω_i + ω_r|².
    float half2 = 0.25f * (square(sin_i + f.sin_r) + square(cos_i - f.cos_r)) + cos_i * f.cos_r * c2;
    float scale = 0.141047396f / beta * s.specular;  // 2 · 1/(4 √2 √(2π)): specular 0.5 is 1
    return scale * lobe * hair_fresnel(sqrt(half2));
}

/// N_TT times 2^lobe: h by the slides' fit (1 - h² clamped), absorption C^(√(1 - h²a²) / 2 cos θd) as
/// shipped, D ≈ e^(-3.65 cos φ - 3.98).
VELLUS_FN vec3 karis_tt_azimuthal(vec3 log2_color, float lobe, float cos_d, float cos_phi,
                                  float cos_half_phi) {
    float a = cos_d / (1.19f + 0.36f * cos_d * cos_d);  // 1/η′
    float h = (1.0f + a * (0.6f - 0.8f * cos_phi)) * cos_half_phi;
    float h2 = min(h * h, 1.0f);
    float through = 1.0f - hair_fresnel(cos_d * sqrt(1.0f - h2));
    float path = 0.5f * sqrt(1.0f - h2 * a * a) / max(cos_d, kHairMinCosD);
    float exponent = lobe - kLog2E * (3.65f * cos_phi + 3.98f);
    return exp2(log2_color * path + vec3(exponent)) * (through * through);
}

/// M_TT N_TT.
VELLUS_FN vec3 karis_tt(HairSurface s, vec3 log2_color, float sin_sum, float cos_d, float cos_phi,
                        float cos_half_phi) {
    float beta = max(0.5f * s.roughness * s.roughness, kHairMinBeta);
    float x = (sin_sum - s.shift) / beta;
    return karis_tt_azimuthal(log2_color, -0.5f * kLog2E * x * x, cos_d, cos_phi, cos_half_phi) *
           (0.398942280f / beta);
}

/// N_TRT times 2^lobe: h = √3/2, absorption C^(0.8 / cos θd), D ≈ e^(17 cos φ - 16.78).
VELLUS_FN vec3 karis_trt_azimuthal(vec3 log2_color, float lobe, float cos_d, float cos_phi) {
    float reflected = hair_fresnel(0.5f * cos_d);
    float through = 1.0f - reflected;
    float exponent = lobe + kLog2E * (17.0f * cos_phi - 16.78f);
    vec3 absorbed = exp2(log2_color * (0.8f / max(cos_d, kHairMinCosD)) + vec3(exponent));
    return absorbed * (through * through * reflected);
}

/// M_TRT N_TRT.
VELLUS_FN vec3 karis_trt(HairSurface s, vec3 log2_color, float sin_sum, float cos_d, float cos_phi,
                         float added_beta) {
    float beta = max(2.0f * s.roughness * s.roughness, kHairMinBeta) + added_beta;
    float x = (sin_sum - 4.0f * s.shift) / beta;
    return karis_trt_azimuthal(log2_color, -0.5f * kLog2E * x * x, cos_d, cos_phi) *
           (0.398942280f / beta);
}

/// S = R + TT + TRT [1/sr] for a beam from `to_light` (unit).
VELLUS_FN vec3 karis_bsdf(HairSurface s, HairFrame f, vec3 to_light) {
    HairAngles a = hair_angles(f, to_light);
    float sin_sum = a.sin_i + f.sin_r;
    vec3 log2_color = hair_log2_color(s.base_color);
    return vec3(karis_r(s, f, a.sin_i, a.cos_i, a.cos_half_phi, 0.0f)) +
           karis_tt(s, log2_color, sin_sum, a.cos_d, a.cos_phi, a.cos_half_phi) +
           karis_trt(s, log2_color, sin_sum, a.cos_d, a.cos_phi, 0.0f);
}

/// Fake-normal scattering [1/sr]: √C (n·ω_i + 1)/4π (C/Luma)^(1 - shadow), scaled by `scatter`; shadow 1
/// means lit; the tint of black is 1.
VELLUS_FN vec3 karis_scattering(HairSurface s, HairFrame f, vec3 to_light, float shadow) {
    vec3 c = max(s.base_color, vec3(kHairMinColor));
    float luma = dot(c, vec3(0.3f, 0.59f, 0.11f));
    vec3 tinted = exp2(log2(c) * (1.5f - shadow) - vec3(log2(luma) * (1.0f - shadow)));
    float wrap = max(dot(f.normal, to_light) + 1.0f, 0.0f);
    return tinted * (s.scatter * wrap * (0.25f * kInvPi));
}

/// Radiance to the eye per unit irradiance across the beam: shadow (S + scattering cos θi).
/// `shadow` in [0, 1] is the light that reaches the fibre (1 = lit).
VELLUS_FN vec3 karis_direct(HairSurface s, HairFrame f, vec3 to_light, float shadow) {
    float sin_i = clamp(dot(f.tangent, to_light), -1.0f, 1.0f);
    float cos_i = safe_sqrt(1.0f - sin_i * sin_i);
    return (karis_bsdf(s, f, to_light) + karis_scattering(s, f, to_light, shadow) * cos_i) * shadow;
}

/// Radiance to the eye under an environment; `sh_radiance` is irradiance/π in the fake normal's direction
/// (light/sh.glsl). Slides, "Environment lighting": a directional light from n (ω_i = n, so θi = φ = 0)
/// of irradiance π sh_radiance, R times saturate(ω_i·ω_r + 1) (here 1), no TT, 0.2 added to each β.
VELLUS_FN vec3 karis_environment(HairSurface s, HairFrame f, vec3 sh_radiance) {
    float cos_d = min(0.5f * sqrt(square(1.0f + f.cos_r) + square(f.sin_r)), 1.0f);
    vec3 log2_color = hair_log2_color(s.base_color);
    vec3 single = vec3(karis_r(s, f, 0.0f, 1.0f, 1.0f, 0.2f)) +
                  karis_trt(s, log2_color, f.sin_r, cos_d, 1.0f, 0.2f);
    return sh_radiance * (single * kPi + sqrt(s.base_color) * (0.5f * s.scatter));
}

#endif
