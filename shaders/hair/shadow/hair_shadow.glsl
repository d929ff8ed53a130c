// How much of a punctual light passes the hair in front: PCF over exponential falloff. GLSL only.
#ifndef VELLUS_HAIR_SHADOW_GLSL
#define VELLUS_HAIR_SHADOW_GLSL
#include "hair/shadow/pcf_exponential.glsl"
#include "light/lights.glsl"

vec4 hair_depths(PunctualLight light, ivec2 corner) {
    int size = int(light.hair_size);
    ivec2 low = clamp(corner, ivec2(0), ivec2(size - 1));
    ivec2 high = clamp(corner + 1, ivec2(0), ivec2(size - 1));
    return uintBitsToFloat(uvec4(light.hair_depth.at[high.y * size + low.x],
                                 light.hair_depth.at[high.y * size + high.x],
                                 light.hair_depth.at[low.y * size + high.x],
                                 light.hair_depth.at[low.y * size + low.x]));
}

/// Transmittance in [0, 1] from the light to `p`. `falloff` in 1/m: extinction behind the closest hair.
/// `first` in metres lies deeper than the closest hair without shadow, so that a strand is not in its
/// own.
float hair_transmittance(PunctualLight light, vec3 p, float falloff, float first) {
    vec2 uv;
    float depth;
    if (uint64_t(light.hair_depth) == 0ul || !shadow_position(light.to_hair, p, uv, depth)) return 1.0;
    float metres = shadow_metres(light, light.hair_range, depth) - first;
    vec2 texel = uv * float(light.hair_size) - 0.5;
    ivec2 corner = ivec2(floor(texel));
    vec4 q[4];
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
        vec4 occluders = shadow_metres(light, light.hair_range, hair_depths(light, corner + offset));
        q[i] = exponential_transmittance(metres, occluders, falloff);
    }
    return pcf_box_filter(fract(texel), q[0], q[1], q[2], q[3]);
}

#endif
