// Filtered shadow map with exponential falloff (B. Karis, SIGGRAPH 2016, "Shadowing"), and the ordinary
// comparison for opaque casters. Depths are distances from the light in metres, growing away from it;
// an empty texel holds any depth beyond the scene.
//
// The filter averages transmittances, after the exponential: what arrives is the mean of the light that
// each path lets through. Averaging depths first (exp of a mean) darkens every edge, by Jensen's
// inequality, and lets one far texel decide for all.
#ifndef VELLUS_HAIR_PCF_EXPONENTIAL_GLSL
#define VELLUS_HAIR_PCF_EXPONENTIAL_GLSL
#include "common/portable.glsl"

/// e^(-falloff max(receiver - occluder, 0)), in [0, 1]; `falloff` >= 0 in 1/m. Never e^(cz) alone.
VELLUS_FN float exponential_transmittance(float receiver, float occluder, float falloff) {
    return exp(-falloff * max(receiver - occluder, 0.0f));
}

/// As above for the four texels of a textureGather.
VELLUS_FN vec4 exponential_transmittance(float receiver, vec4 occluders, float falloff) {
    return exp(-falloff * max(vec4(receiver) - occluders, vec4(0.0f)));
}

/// Light past opaque casters for the four texels of a textureGather: 1 up to a depth difference of
/// `bias` metres (> 0), 0 from 2 bias on, a ramp between, so that acne cannot flicker.
VELLUS_FN vec4 opaque_visibility(float receiver, vec4 occluders, float bias) {
    return clamp(vec4(2.0f) - (vec4(receiver) - occluders) / bias, vec4(0.0f), vec4(1.0f));
}

/// Position inside the 2×2 texels around `uv`: fract(uv size - ½).
VELLUS_FN vec2 pcf_fraction(vec2 uv, vec2 map_size) { return fract(uv * map_size - vec2(0.5f)); }

/// Bilinear weights in textureGather's order: (0,1), (1,1), (1,0), (0,0).
VELLUS_FN vec4 pcf_gather_weights(vec2 fraction) {
    vec2 f = fraction;
    vec2 g = vec2(1.0f) - f;
    return vec4(g.x * f.y, f.x * f.y, f.x * g.y, g.x * g.y);
}

/// One axis of a 3-texel box moved by `fraction` over 4 texels; weights of texels -1, 0, 1, 2.
VELLUS_FN vec4 pcf_box_weights(float fraction) {
    return vec4(1.0f - fraction, 1.0f, 1.0f, fraction) * (1.0f / 3.0f);
}

/// The 4×4 filter of pcf_box_weights from four textureGathers with offsets (-1,-1), (1,-1), (-1,1), (1,1)
/// around the 2×2 centre; each argument holds the filtered quantity, not depths.
VELLUS_FN float pcf_box_filter(vec2 fraction, vec4 q00, vec4 q10, vec4 q01, vec4 q11) {
    vec4 wx = pcf_box_weights(fraction.x);
    vec4 wy = pcf_box_weights(fraction.y);
    float row0 = wx.x * q00.w + wx.y * q00.z + wx.z * q10.w + wx.w * q10.z;
    float row1 = wx.x * q00.x + wx.y * q00.y + wx.z * q10.x + wx.w * q10.y;
    float row2 = wx.x * q01.w + wx.y * q01.z + wx.z * q11.w + wx.w * q11.z;
    float row3 = wx.x * q01.x + wx.y * q01.y + wx.z * q11.x + wx.w * q11.y;
    return wy.x * row0 + wy.y * row1 + wy.z * row2 + wy.w * row3;
}

/// Where a surface looks its shadow up: moved along its normal by the texels the filter covers, more the
/// more the light grazes, so that a plane never shadows itself. `texel` is a texel's size in metres at the
/// receiver; twice that for the 4×4 filter.
VELLUS_FN vec3 shadow_normal_offset(vec3 normal, vec3 to_light, float texel) {
    float cosine = saturate(dot(normal, to_light));
    return normal * (texel * (0.5f + 1.5f * sqrt(1.0f - cosine * cosine)));
}

#endif
