#version 460
#extension GL_GOOGLE_include_directive : require
#include "character/mesh_data.glsl"

// Depth of opaque casters as a light sees them.
layout(push_constant, scalar) uniform Push {
    mat4 to_shadow;  // position relative to the camera -> clip space of the shadow map
    SkinnedVertices vertices;
};

void main() {
    gl_Position = to_shadow * vec4(vertices.at[gl_VertexIndex].position, 1.0);
}
