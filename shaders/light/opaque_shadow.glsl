// How much of a punctual light passes the opaque casters. GLSL only.
#ifndef VELLUS_OPAQUE_SHADOW_GLSL
#define VELLUS_OPAQUE_SHADOW_GLSL
#include "hair/shadow/pcf_exponential.glsl"
#include "light/lights.glsl"

// Four texels around the corner at the end of texel `corner`, in textureGather's order, kept inside the
// light's own tile.
vec4 opaque_depths(sampler2D atlas, PunctualLight light, ivec2 corner) {
    int size = int(light.opaque_size);
    ivec2 low = clamp(corner, ivec2(0), ivec2(max(size - 2, 0)));
    vec2 at = vec2(low + ivec2(1 + int(light.shadow_tile) * size, 1));
    return textureGather(atlas, at / vec2(textureSize(atlas, 0)));
}

/// Visibility in [0, 1] by percentage-closer filtering: a box of 3x3 texels, moved smoothly. `p` is
/// already offset along the normal (shadow_normal_offset).
float opaque_visibility(sampler2D atlas, PunctualLight light, vec3 p) {
    vec2 uv;
    float depth;
    if (light.shadow_tile == kNoShadow || !shadow_position(light.to_opaque, p, uv, depth)) return 1.0;
    float metres = shadow_metres(light, light.opaque_range, depth);
    float bias = max(2.0 * shadow_texel_metres(light, light.opaque_texel, metres), 1.0e-4);
    vec2 texel = uv * float(light.opaque_size) - 0.5;
    ivec2 corner = ivec2(floor(texel));
    vec4 q[4];
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
        vec4 occluders = shadow_metres(light, light.opaque_range, opaque_depths(atlas, light, corner + offset));
        q[i] = opaque_visibility(metres, occluders, bias);
    }
    return pcf_box_filter(fract(texel), q[0], q[1], q[2], q[3]);
}

#endif
