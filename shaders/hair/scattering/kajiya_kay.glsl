// Kajiya and Kay 1989, "Rendering Fur with Three Dimensional Textures": k_d sin(T, L) + k_s cos^p(θi + θr),
// with the signs and parameters of modules/hair/reference/kajiya_kay.h.
#ifndef VELLUS_HAIR_KAJIYA_KAY_GLSL
#define VELLUS_HAIR_KAJIYA_KAY_GLSL
#include "hair/scattering/karis.glsl"

/// S [1/sr] for a beam from `to_light` (unit); the highlight has no shift, as in the paper.
VELLUS_FN vec3 kajiya_kay_bsdf(HairSurface s, HairFrame f, vec3 to_light) {
    float sin_i = clamp(dot(f.tangent, to_light), -1.0f, 1.0f);
    vec3 across = to_light - sin_i * f.tangent;
    float cos_i = min(length(across), 1.0f);
    float beta = max(s.roughness * s.roughness, kHairMinBeta);
    // cos(θi + θr) = 1 - ½ d² by the chord d, exact where the exponent is large; ln(1 - y) follows the
    // rounding of 1 - y (Kahan), so that it keeps its relative precision at small y.
    float y = 0.5f * (square(cos_i - f.cos_r) + square(sin_i + f.sin_r));
    float u = max(1.0f - y, 0.0f);
    float lost = 1.0f - u;
    float log_u = lost > 0.0f && u > 0.0f ? log2(u) * (y / lost) : -kLog2E * y;
    float highlight = u > 0.0f ? exp2(log_u / (beta * beta)) : 0.0f;
    float peak = 2.0f * s.specular * 0.04652057f / (2.0f * kPi * 2.50662827f * beta);
    return s.base_color * (cos_i * kInvPi * kInvPi) + vec3(peak * highlight);
}

#endif
