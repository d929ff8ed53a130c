#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_atomic_int64 : require
#include "common/thread.glsl"
#include "hair/cards/cards.glsl"
#include "hair/opacity/dither.glsl"

// Cards into the strands' visibility buffer: depth moved by the atlas's depth, id of the triangle.
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kStill = false;  // opacity=dither_still
layout(push_constant, scalar) uniform Push {
    Cards cards;
    CardVertices vertices;
    LongWords target;
    ivec2 size;
    uint first_id;
    uint frame;
    float alpha_scale;
    uint threads;  // that share a triangle
    uint triangle_count;
};

uint id;

bool hidden(ivec2 pixel, float depth) {
    return uint(target.at[uint(pixel.y * size.x + pixel.x)] >> 32) > floatBitsToUint(max(depth, 0.0));
}

void fragment(ivec2 pixel, CardFragment at) {
    uint index = uint(pixel.y * size.x + pixel.x);
    uint64_t key = (uint64_t(floatBitsToUint(clamp(at.depth, 1.0e-30, 1.0))) << 32) | uint64_t(id);
    if (target.at[index] >= key) return;
    DitherStrand dither = dither_strand(at.seed);
    float threshold = kStill ? dither_threshold_still(dither, uvec2(pixel))
                             : dither_threshold(dither, uvec2(pixel), frame);
    if (dither_keeps(at.alpha * alpha_scale, threshold)) atomicMax(target.at[index], key);
}

#include "hair/cards/raster.glsl"

void main() {
    uint triangle = thread_index() / threads;
    if (triangle >= triangle_count) return;
    id = first_id + triangle + 1u;
    CardSet set = cards.set;
    walk_card_triangle(set, vertices, triangle, thread_index() % threads, threads, size);
}
