#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/geometry/strands.glsl"

// Points of a groom that no mesh carries but that a later pass will move: with its node, this frame and
// the last.
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) writeonly buffer Points { vec3 at[]; };
layout(push_constant, scalar) uniform Push {
    mat4x3 node;  // groom to metres from its anchor
    mat4x3 previous_node;
    Vec3s positions;
    uint64_t points;  // Points, as a number: push constants hold 128 bytes
    uint point_count;
};

void main() {
    uint i = thread_index();
    if (i >= point_count) return;
    vec4 p = vec4(positions.at[i], 1.0);
    Points out_points = Points(points);
    out_points.at[i] = node * p;
    out_points.at[((point_count + 3u) & ~3u) + i] = previous_node * p;
}
