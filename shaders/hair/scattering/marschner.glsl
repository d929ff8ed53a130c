// Marschner et al. 2003, "Light Scattering from Human Hair Fibers": Gaussians in θh, closed-form N_p. In the
// convention of modules/hair/reference/marschner.h (S here is the paper's S cos θi, M half the paper's).
// TT's offset is solved exactly, TRT's by the paper's cubic (§5.2.1: γt ≈ 3c/π γi - 4c/π³ γi³,
// c = asin 1/η'); TRT's caustics become glints (§5.2.3) with the parameters of the reference.
#ifndef VELLUS_HAIR_MARSCHNER_GLSL
#define VELLUS_HAIR_MARSCHNER_GLSL
#include "hair/scattering/fibre.glsl"

const float kGlintWidth = 0.26f;  // w_c
const float kGlintScale = 0.5f;   // k_G
const float kGlintFade = 0.3f;    // Δη'
const float kGlintOffset = 0.5f;  // Δh_M

/// Fresnel reflectance by Bravais's two indices (appendix B).
VELLUS_FN float marschner_fresnel(float index2_1, float cos_d, float cos_i) {
    float c = cos_d * cos_i;
    float g = sqrt(index2_1 + c * c);
    float across = square((c - g) / (c + g));
    float index = (index2_1 + 1.0f) * cos_d * inversesqrt(index2_1 + cos_d * cos_d);
    float inside = safe_sqrt(index * index - 1.0f + cos_i * cos_i);  // index cos γt
    float along = square((index * index * cos_i - inside) / max(index * index * cos_i + inside, 1.0e-9f));
    return 0.5f * (across + along);
}

/// N_TT at cos φ/2.
VELLUS_FN vec3 marschner_tt(VELLUS_IN(HairFibre) fibre, vec3 half_log, float cos_d, float inverse,
                            float cos_half_phi) {
    float sin_half = safe_sqrt(1.0f - cos_half_phi * cos_half_phi);
    if (sin_half < inverse) return vec3(0.0f);
    float h2 = min(cos_half_phi * cos_half_phi / (1.0f + inverse * inverse - 2.0f * inverse * sin_half), 1.0f);
    float cos_i = sqrt(1.0f - h2);
    float cos_t = sqrt(1.0f - h2 * inverse * inverse);
    float slope = 2.0f * abs(1.0f - inverse * cos_i / cos_t);
    float through = 1.0f - marschner_fresnel(fibre.index2_1, cos_d, cos_i);
    return exp2(half_log * cos_t) * (0.5f * through * through * cos_i / max(slope, 1.0e-4f));
}

/// A(2, h) cos γi ½ / |slope| of a root γi of the cubic; 0 beyond the fibre.
VELLUS_FN vec3 marschner_trt_root(VELLUS_IN(HairFibre) fibre, vec3 half_log, float cos_d, float inverse,
                                  float gamma, float slope) {
    if (abs(gamma) >= 0.5f * kPi) return vec3(0.0f);
    float cos_i = max(cos(gamma), 0.0f);
    float sin_t = sin(gamma) * inverse;
    float reflected = marschner_fresnel(fibre.index2_1, cos_d, cos_i);
    float a = square(1.0f - reflected) * reflected;
    return exp2(2.0f * half_log * sqrt(1.0f - sin_t * sin_t)) *
           (0.5f * a * cos_i / max(abs(slope), 1.0e-6f));
}

/// Σ over the roots of first γ - third γ³ = φ, φ in [0, π].
VELLUS_FN vec3 marschner_trt_sum(VELLUS_IN(HairFibre) fibre, vec3 half_log, float cos_d, float inverse,
                                 float first, float third, float phi) {
    float p = -first / third;
    float q = phi / third;
    float half_q = 0.5f * q;
    float p3 = p * (1.0f / 3.0f);
    float discriminant = half_q * half_q + p3 * p3 * p3;
    if (discriminant >= 0.0f) {
        float t = pow(max(half_q + sqrt(discriminant), 1.0e-30f), 1.0f / 3.0f);
        float other = p3 / t;
        // For p > 0 the sum of the two real parts cancels; this form does not.
        float gamma = p > 0.0f ? -q / (t * t + p3 + other * other) : other - t;
        return marschner_trt_root(fibre, half_log, cos_d, inverse, gamma, first - 3.0f * third * gamma * gamma);
    }
    float radius = sqrt(-p3);
    float angle = acos(clamp(half_q / (p3 * radius), -1.0f, 1.0f)) * (1.0f / 3.0f);
    vec3 sum = vec3(0.0f);
    for (int k = 0; k < 3; ++k) {
        float gamma = 2.0f * radius * cos(angle - 2.0f * kPi / 3.0f * float(k));
        sum += marschner_trt_root(fibre, half_log, cos_d, inverse, gamma, first - 3.0f * third * gamma * gamma);
    }
    return sum;
}

VELLUS_FN float marschner_gaussian(float x) { return exp2(-0.5f * kLog2E * x * x); }

/// N_TRT with glints in place of caustics, φ in [0, π].
VELLUS_FN vec3 marschner_trt(VELLUS_IN(HairFibre) fibre, vec3 half_log, float cos_d, float inverse,
                             float phi) {
    float c = asin(clamp(inverse, 1.0e-3f, 1.0f));
    float first = 12.0f * kInvPi * c - 2.0f;
    float third = 16.0f * kInvPi * kInvPi * kInvPi * c;
    float caustic = 0.0f;
    float caustic_phi = 0.0f;
    float offset = kGlintOffset;
    float fade = 1.0f;
    if (first > 0.0f) {  // η' < 2
        caustic = sqrt(first / (3.0f * third));
        caustic_phi = 2.0f / 3.0f * first * caustic;
        // Φ'' in h at the caustic, where dΦ/dγ = 0: that in γ over cos² γ.
        float curvature = 6.0f * third * caustic / max(square(cos(caustic)), 1.0e-4f);
        offset = min(offset, 2.0f * sqrt(2.0f * kGlintWidth / max(curvature, 1.0e-6f)));
    } else {
        float x = saturate((1.0f / max(inverse, 1.0e-3f) - 2.0f) / kGlintFade);
        fade = 1.0f - x * x * (3.0f - 2.0f * x);
    }
    float left = marschner_gaussian((phi - caustic_phi) / kGlintWidth);
    float right = marschner_gaussian((phi + caustic_phi) / kGlintWidth);
    vec3 lobe = marschner_trt_sum(fibre, half_log, cos_d, inverse, first, third, phi);
    lobe *= (1.0f - fade * left) * (1.0f - fade * right);
    float cos_i = cos(caustic);
    float reflected = marschner_fresnel(fibre.index2_1, cos_d, cos_i);
    float sin_t = sin(caustic) * inverse;
    vec3 glint = exp2(2.0f * half_log * sqrt(1.0f - sin_t * sin_t)) * (square(1.0f - reflected) * reflected);
    return lobe + glint * (fade * kGlintScale * offset * 0.398942280f / kGlintWidth * (left + right));
}

/// S of R + TT + TRT [1/sr].
VELLUS_FN vec3 marschner_bsdf(VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, vec3 to_light) {
    HairAngles a = hair_angles(f, to_light);
    float cos_d = max(a.cos_d, kHairMinCosD);
    float sin_sum = a.sin_i + f.sin_r;
    float half_chord = 0.5f * sqrt(square(sin_sum) + square(a.cos_i - f.cos_r));  // |sin θh|
    float turned = 2.0f * asin(min(half_chord, 1.0f));
    vec3 tilt = vec3(asin(fibre.sin_tilt.x), asin(fibre.sin_tilt.y), asin(fibre.sin_tilt.z));
    vec3 x = vec3(sin_sum < 0.0f ? -turned : turned) - tilt;
    vec3 m = exp2(-0.5f * kLog2E * x * x * fibre.inverse_v) * sqrt(fibre.inverse_v) * 0.398942280f;
    float r = 0.5f * s.specular * a.cos_half_phi *
              marschner_fresnel(fibre.index2_1, cos_d, a.cos_half_phi);
    float inverse = cos_d * inversesqrt(fibre.index2_1 + cos_d * cos_d);
    float cos2_t = 1.0f - (1.0f - cos_d * cos_d) * fibre.inverse_index2;
    vec3 half_log = hair_log2_color(s.base_color) * (0.5f * inversesqrt(cos2_t));
    vec3 tt = marschner_tt(fibre, half_log, cos_d, inverse, a.cos_half_phi);
    float phi = 2.0f * acos(clamp(a.cos_half_phi, 0.0f, 1.0f));
    vec3 trt = marschner_trt(fibre, half_log, cos_d, inverse, phi);
    return (vec3(m.x * r) + m.y * tt + m.z * trt) * (a.cos_i / (cos_d * cos_d));
}

#endif
