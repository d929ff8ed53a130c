#version 460
#extension GL_EXT_scalar_block_layout : require

// A triangle over half of the picture at a given depth.
layout(push_constant, scalar) uniform Push { float depth; float brightness; };

void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    gl_Position = vec4(corner * 2.0 - 1.0, depth, 1.0);
}
