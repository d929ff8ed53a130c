#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_atomic_int64 : require
#include "hair/geometry/strands.glsl"

// Closest visible segment of each pixel: depth in the high word (reversed Z, larger is nearer),
// segment + 1 in the low word; 0 is empty.
layout(local_size_x = 64) in;
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

uint seed;
uint id;

uint mix_bits(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

void fragment(ivec2 pixel, float depth, float coverage) {
    uint index = uint(pixel.y * size.x + pixel.x);
    float threshold = float(mix_bits(index ^ seed ^ (frame * 0x9e3779b9u)) >> 8) * (1.0 / 16777216.0);
    if (threshold >= coverage * alpha) return;
    uint64_t key = (uint64_t(floatBitsToUint(depth)) << 32) | uint64_t(id);
    if (target.at[index] < key) atomicMax(target.at[index], key);
}

#include "hair/geometry/raster.glsl"

void main() {
    uint segment = gl_GlobalInvocationID.x;
    if (segment >= segment_count) return;
    uint point = segment_point.at[segment];
    seed = strand_seed.at[segment_strand.at[segment]];
    id = first_id + segment + 1u;
    walk_segment(projected.at[point], projected.at[point + 1u], size);
}
