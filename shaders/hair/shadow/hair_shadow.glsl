// How much of a punctual light passes the hair in front: PCF over exponential falloff. GLSL only.
#ifndef VELLUS_HAIR_SHADOW_GLSL
#define VELLUS_HAIR_SHADOW_GLSL
#extension GL_EXT_control_flow_attributes : require
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

/// Optical depth in one texel's layers in front of a fragment `metres` from the light. The strand that
/// it lies on, which covers `own` of the texel, is not in front of itself.
float deep_optical_depth(PunctualLight light, ivec2 texel, float metres, float own) {
    uint word = uint(texel.y * int(light.layers_size) + texel.x) * kDeepWords;
    float front = shadow_metres(light, light.hair_range, uintBitsToFloat(light.hair_layers.at[word]));
    float behind = metres - front;
    DeepPlace place = deep_place(max(behind, 0.0), light.layers_span);
    // What lies before the front comes first. How it is spread is unknown: as over the first layer.
    uint last = behind < 0.0 ? 0u : 1u + place.layer;
    float first_end = 2.0 / float(kDeepLayers * (kDeepLayers - 1u)) * light.layers_span;
    float share = behind < 0.0 ? saturate(1.0 + behind / first_end) : place.share;
    float own_units = behind < 0.0 ? 0.0 : own * kDeepUnit;
    float sum = 0.0;
    for (uint k = 0u; k <= last; ++k) {
        float layer = float(light.hair_layers.at[word + kDeepBefore + k]);
        sum += k < last ? layer : share * max(layer - own_units, 0.0);
    }
    return sum * (1.0 / kDeepUnit);
}

/// Where a deep opacity map sees a point: texels around it, its depth, and what its own strand covers.
struct DeepPoint {
    vec2 texel;  // negative where the light has no layers or does not see it
    float metres;
    float own;
};

DeepPoint deep_point(PunctualLight light, vec3 p, float width) {
    vec2 uv;
    float depth;
    if (uint64_t(light.hair_layers) == 0ul || !shadow_position(light.to_hair, p, uv, depth)) {
        return DeepPoint(vec2(-1.0), 0.0, 0.0);
    }
    float metres = shadow_metres(light, light.hair_range, depth);
    float cover = width / (2.0 * shadow_texel_metres(light, light.hair_texel, metres));
    return DeepPoint(uv * float(light.layers_size), metres, 0.75 * deep_optical_depth_of(cover));
}

bool deep_knows(DeepPoint at) { return at.texel.x >= 0.0; }

/// Transmittance in [0, 1] from the light to a point. A CPU device runs both sides of a branch but leaves a loop
/// that no pixel of several is in: most pixels lie where no map is.
float deep_transmittance(PunctualLight light, DeepPoint at) {
    if (!deep_knows(at)) return 1.0;
    vec2 texel = at.texel - 0.5;
    ivec2 corner = ivec2(floor(texel));
    vec2 f = fract(texel);
    float sum = 0.0;
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 nearby = clamp(corner + offset, ivec2(0), ivec2(int(light.layers_size) - 1));
        vec2 weight = mix(1.0 - f, f, vec2(offset));
        sum += weight.x * weight.y * exp(-deep_optical_depth(light, nearby, at.metres, at.own));
    }
    return sum;
}

/// Optical depth of the hair that a point which the map knows has behind it, of the closest texel: what
/// it is for varies slowly.
float deep_behind(PunctualLight light, DeepPoint at) {
    ivec2 texel = min(ivec2(at.texel), ivec2(int(light.layers_size) - 1));
    uint word = uint(texel.y * int(light.layers_size) + texel.x) * kDeepWords;
    float front = shadow_metres(light, light.hair_range, uintBitsToFloat(light.hair_layers.at[word]));
    DeepPlace place = deep_place(max(at.metres - front, 0.0), light.layers_span);
    float sum = 0.0;
    for (uint k = place.layer; k < kDeepLayers; ++k) {
        float layer = float(light.hair_layers.at[word + kDeepFirst + k]);
        sum += k > place.layer ? layer : (1.0 - place.share) * max(layer - at.own * kDeepUnit, 0.0);
    }
    return sum * (1.0 / kDeepUnit);
}

#endif
