#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_atomic_int64 : require
#include "common/portable.glsl"
#include "common/thread.glsl"
#include "hair/geometry/strands.glsl"
#include "hair/opacity/dither.glsl"

// Closest visible segment of each pixel: depth in the high word (reversed Z, larger is nearer),
// segment + 1 in the low word; 0 is empty.
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kStill = false;  // opacity=dither_still
layout(push_constant, scalar) uniform Push {
    ProjectedPoints projected;
    Uints segment_point;
    Uints segment_strand;
    Uints strand_seed;
    LongWords target;
    ivec2 size;
    uint segment_count;
    uint first_id;
    uint frame;
    float alpha;
};

DitherStrand dither;
uint id;

void fragment(ivec2 pixel, float depth, float coverage) {
    uint index = uint(pixel.y * size.x + pixel.x);
    float threshold = kStill ? dither_threshold_still(dither, uvec2(pixel))
                             : dither_threshold(dither, uvec2(pixel), frame);
    if (!dither_keeps(coverage * alpha, threshold)) return;
    uint64_t key = (uint64_t(floatBitsToUint(depth)) << 32) | uint64_t(id);
    if (target.at[index] < key) atomicMax(target.at[index], key);
}

#include "hair/geometry/raster.glsl"

void main() {
    uint segment = thread_index();
    if (segment >= segment_count) return;
    uint point = segment_point.at[segment];
    dither = dither_strand(strand_seed.at[segment_strand.at[segment]]);
    id = first_id + segment + 1u;
    walk_segment(projected.at[point], projected.at[point + 1u], size);
}
