#version 460
#extension GL_GOOGLE_include_directive : require
#include "character/mesh_data.glsl"
#include "light/lights.glsl"

// Depth of opaque casters as a light sees them.
layout(push_constant, scalar) uniform Push {
    Lights lights;
    SkinnedVertices vertices;
    uint light_index;
};

void main() {
    gl_Position = lights.block.light[light_index].to_shadow *
                  vec4(vertices.at[gl_VertexIndex].position, 1.0);
}
