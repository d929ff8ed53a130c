// How much of a punctual light passes the hair in front: PCF over exponential falloff. GLSL only.
#ifndef VELLUS_HAIR_SHADOW_GLSL
#define VELLUS_HAIR_SHADOW_GLSL
#include "hair/shadow/deep_opacity.glsl"
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

/// Optical depth in one texel's layers in front of a fragment `metres` from the light (x) and behind it
/// (y). The strand that it lies on, which covers `own` of the texel, is on neither side of itself.
vec2 deep_optical_depths(PunctualLight light, ivec2 texel, float metres, float own) {
    uint word = uint(texel.y * int(light.layers_size) + texel.x) * kDeepWords;
    float front = shadow_metres(light, light.hair_range, uintBitsToFloat(light.hair_layers.at[word]));
    float before = float(light.hair_layers.at[word + kDeepBefore]);
    float depth = metres - front;
    DeepPlace place = deep_place(max(depth, 0.0), light.layers_span);
    float sum = before;
    float rest = 0.0;
    for (uint k = 0u; k < kDeepLayers; ++k) {
        float layer = float(light.hair_layers.at[word + kDeepFirst + k]);
        if (k < place.layer) sum += layer;
        if (k > place.layer) rest += layer;
        if (k == place.layer) {
            layer = max(layer - own * kDeepUnit, 0.0);
            sum += place.share * layer;
            rest += (1.0 - place.share) * layer;
        }
    }
    if (depth < 0.0) {
        // How what lies before the front is spread is unknown: as over the first layer.
        float first = 2.0 / float(kDeepLayers * (kDeepLayers - 1u)) * light.layers_span;
        sum = before * saturate(1.0 + depth / first);
        rest += before - sum;
    }
    return vec2(sum, rest) * (1.0 / kDeepUnit);
}

/// What a deep opacity map knows of a point.
struct DeepLight {
    float transmittance;  // [0, 1] from the light
    float behind;  // optical depth of the hair that the point has behind it
};

/// Through a deep opacity map to `p`; `width` of the strand there in metres.
DeepLight deep_light(PunctualLight light, vec3 p, float width) {
    vec2 uv;
    float depth;
    if (uint64_t(light.hair_layers) == 0ul || !shadow_position(light.to_hair, p, uv, depth)) {
        return DeepLight(1.0, 0.0);
    }
    float metres = shadow_metres(light, light.hair_range, depth);
    float own = 0.75 * deep_optical_depth_of(width / (2.0 * shadow_texel_metres(light, light.hair_texel, metres)));
    vec2 texel = uv * float(light.layers_size) - 0.5;
    ivec2 low = max(ivec2(floor(texel)), ivec2(0));
    ivec2 high = min(ivec2(floor(texel)) + 1, ivec2(int(light.layers_size) - 1));
    vec2 f = fract(texel);
    vec2 a = deep_optical_depths(light, low, metres, own);
    vec2 b = deep_optical_depths(light, ivec2(high.x, low.y), metres, own);
    vec2 c = deep_optical_depths(light, ivec2(low.x, high.y), metres, own);
    vec2 d = deep_optical_depths(light, high, metres, own);
    vec4 weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    return DeepLight(dot(weight, exp(-vec4(a.x, b.x, c.x, d.x))), dot(weight, vec4(a.y, b.y, c.y, d.y)));
}

/// Transmittance in [0, 1] from the light to `p` through a deep opacity map; `width` of the strand there
/// in metres.
float deep_transmittance(PunctualLight light, vec3 p, float width) {
    return deep_light(light, p, width).transmittance;
}

#endif
