#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/portable.glsl"
#include "common/thread.glsl"
#include "hair/shadow/deep_add.glsl"

// Strands into the layers of a light's deep opacity map: each adds the share of every texel it covers.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    ProjectedPoints projected;  // to the shadow map, which has twice as many texels along a side
    Uints segment_point;
    DeepTarget target;
    uint segment_count;
    float alpha;
};

void fragment(ivec2 texel, float depth, float coverage) { deep_add(target, texel, depth, coverage * alpha, 1.0); }

#include "hair/geometry/raster.glsl"

void main() {
    uint segment = thread_index();
    if (segment >= segment_count) return;
    uint point = segment_point.at[segment];
    const vec4 half_size = vec4(0.5, 0.5, 1.0, 0.5);
    walk_segment(projected.at[point] * half_size, projected.at[point + 1u] * half_size, ivec2(target.size));
}
