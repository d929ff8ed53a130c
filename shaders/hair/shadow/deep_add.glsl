// Adds to a texel of a deep opacity map. GLSL only; the includer's push constants are a DeepTarget.
#ifndef VELLUS_HAIR_DEEP_ADD_GLSL
#define VELLUS_HAIR_DEEP_ADD_GLSL
#include "hair/geometry/strands.glsl"
#include "hair/shadow/deep_opacity.glsl"

struct DeepTarget {
    Words layers;
    int size;
    uint sun;     // depths are linear: 1 - depth, times range; else range / depth
    float range;  // metres
    float span;
};

float deep_metres(DeepTarget target, float depth) {
    return target.sun != 0u ? (1.0 - depth) * target.range : target.range / max(depth, 1.0e-30);
}

/// `fibres` lie over the texel at `depth`, one after the other for light.
void deep_add_fibres(DeepTarget target, ivec2 texel, float depth, float fibres) {
    uint word = uint(texel.y * target.size + texel.x) * kDeepWords;
    float behind = deep_metres(target, depth) -
                   deep_metres(target, uintBitsToFloat(target.layers.at[word]));
    uint units = deep_units(fibres);
    if (units == 0u) return;
    uint place = behind >= 0.0 ? kDeepFirst + deep_place(behind, target.span).layer : kDeepBefore;
    atomicAdd(target.layers.at[word + place], units);
}

/// `share` in [0, 1] of the light in `weight` of the texel is stopped at `depth`.
void deep_add(DeepTarget target, ivec2 texel, float depth, float share, float weight) {
    deep_add_fibres(target, texel, depth, weight * deep_optical_depth_of(share));
}

#endif
