#version 460
#extension GL_GOOGLE_include_directive : require
#include "hair/geometry/strands.glsl"

// A segment as a hardware line: two vertices, from points projected in compute.
layout(push_constant, scalar) uniform Push {
    ProjectedPoints projected;
    Uints segment_point;
    vec2 size;
};
layout(location = 0) flat out uint id;

void main() {
    uint segment = uint(gl_VertexIndex) >> 1;
    vec4 p = projected.at[segment_point.at[segment] + (uint(gl_VertexIndex) & 1u)];
    gl_Position = vec4(p.xy / size * 2.0 - 1.0, p.z, 1.0);
    id = segment + 1u;
}
