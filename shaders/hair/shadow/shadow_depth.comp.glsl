#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/portable.glsl"
#include "common/thread.glsl"
#include "hair/geometry/strands.glsl"
#include "hair/opacity/dither.glsl"

// Depth of the closest hair in each texel of a light's map: float bits of reversed depth, 0 is empty.
// The dither is a still one: a thin strand fills its share of the texels it crosses, and the filter
// turns that into a transmittance.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    ProjectedPoints projected;
    Uints segment_point;
    Uints segment_strand;
    Uints strand_seed;
    Words target;
    ivec2 size;
    uint segment_count;
    float alpha;
};

DitherStrand dither;

void fragment(ivec2 texel, float depth, float coverage) {
    if (!dither_keeps(coverage * alpha, dither_threshold_still(dither, uvec2(texel)))) return;
    uint index = uint(texel.y * size.x + texel.x);
    uint bits = floatBitsToUint(max(depth, 0.0));
    if (target.at[index] < bits) atomicMax(target.at[index], bits);
}

#include "hair/geometry/raster.glsl"

void main() {
    uint segment = thread_index();
    if (segment >= segment_count) return;
    uint point = segment_point.at[segment];
    dither = dither_strand(strand_seed.at[segment_strand.at[segment]]);
    walk_segment(projected.at[point], projected.at[point + 1u], size);
}
