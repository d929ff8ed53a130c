#version 460
#extension GL_GOOGLE_include_directive : require
#include "hair/geometry/strands.glsl"

// A segment as a ribbon of two triangles, at least a pixel wide.
layout(push_constant, scalar) uniform Push {
    ProjectedPoints projected;
    Uints segment_point;
    vec2 size;
};
layout(location = 0) flat out uint id;

void main() {
    uint segment = uint(gl_VertexIndex) / 6u;
    uint corner = uint(gl_VertexIndex) % 6u;
    bool far_end = corner == 2u || corner == 4u || corner == 5u;
    float side = corner == 1u || corner == 3u || corner == 5u ? 0.5 : -0.5;
    uint first = segment_point.at[segment];
    vec4 a = projected.at[first], b = projected.at[first + 1u];
    vec2 along = b.xy - a.xy;
    vec2 across = vec2(-along.y, along.x) * inversesqrt(max(dot(along, along), 1.0e-12));
    vec4 p = far_end ? b : a;
    vec2 pixel = p.xy + across * side * max(p.w, 1.0);
    gl_Position = vec4(pixel / size * 2.0 - 1.0, p.z, 1.0);
    id = segment + 1u;
}
