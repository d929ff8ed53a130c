// Exposure, tone map and display encoding.
#ifndef VELLUS_TONEMAP_GLSL
#define VELLUS_TONEMAP_GLSL
#include "common/portable.glsl"

/// Khronos PBR Neutral (Khronos Group, "PBR Neutral Tone Mapper" specification, 2024): colours below 0.76
/// keep hue and saturation, so a base colour looks as chosen; highlights compress and lose saturation.
/// `color` linear, >= 0; result in [0, 1].
VELLUS_FN vec3 tonemap_pbr_neutral(vec3 color) {
    const float start = 0.8f - 0.04f;
    float least = min(color.x, min(color.y, color.z));
    vec3 c = color - vec3(least < 0.08f ? least - 6.25f * least * least : 0.04f);
    float peak = max(c.x, max(c.y, c.z));
    float span = 1.0f - start;
    float compressed = 1.0f - span * span / (max(peak, start) + span - start);
    float grey = 1.0f - 1.0f / (0.15f * (peak - compressed) + 1.0f);
    vec3 bright = mix(c * (compressed / max(peak, start)), vec3(compressed), grey);
    return peak < start ? c : bright;
}

/// sRGB's transfer function (IEC 61966-2-1) of values in [0, 1].
VELLUS_FN float srgb_encode(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

/// Linear HDR to display sRGB in [0, 1]; NaN and infinity come out black.
VELLUS_FN vec3 display_color(vec3 linear_color, float exposure) {
    vec3 c = linear_color * exposure;
    vec3 t = tonemap_pbr_neutral(is_finite(c) ? clamp(c, vec3(0.0f), vec3(1.0e6f)) : vec3(0.0f));
    t = clamp(t, vec3(0.0f), vec3(1.0f));
    return vec3(srgb_encode(t.x), srgb_encode(t.y), srgb_encode(t.z));
}

#endif
