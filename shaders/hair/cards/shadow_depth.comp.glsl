#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/cards/cards.glsl"
#include "hair/opacity/dither.glsl"

// Cards into the strands' shadow map of a light: float bits of reversed depth, with the strands' still
// dither.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    Cards cards;
    CardVertices vertices;
    Words target;
    ivec2 size;
    float alpha_scale;
    uint threads;  // that share a triangle
    uint triangle_count;
};

bool hidden(ivec2 texel, float depth) {
    return target.at[uint(texel.y * size.x + texel.x)] >= floatBitsToUint(max(depth, 0.0));
}

void fragment(ivec2 texel, CardFragment at) {
    uint index = uint(texel.y * size.x + texel.x);
    uint bits = floatBitsToUint(max(at.depth, 0.0));
    if (target.at[index] >= bits) return;
    if (!dither_keeps(at.alpha * alpha_scale, dither_threshold_still(dither_strand(at.seed), uvec2(texel)))) {
        return;
    }
    atomicMax(target.at[index], bits);
}

#include "hair/cards/raster.glsl"

void main() {
    uint triangle = thread_index() / threads;
    if (triangle >= triangle_count) return;
    CardSet set = cards.set;
    walk_card_triangle(set, vertices, triangle, thread_index() % threads, threads, size);
}
