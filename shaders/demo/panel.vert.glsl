#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

// Panels over the picture: triangles in pixels, pulled by index.
struct PanelVertex {
    vec2 position;  // pixels, y down
    vec2 texcoord;
    uint color;  // sRGB and alpha, R in the low bits
};
layout(buffer_reference, scalar) readonly buffer Vertices { PanelVertex at[]; };
layout(buffer_reference, scalar) readonly buffer Indices { uint at[]; };

layout(push_constant, scalar) uniform Push {
    Vertices vertices;
    Indices indices;
    vec2 to_clip;  // 2 / size
};

layout(location = 0) out vec2 texcoord;
layout(location = 1) out vec4 color;

void main() {
    PanelVertex v = vertices.at[indices.at[gl_VertexIndex]];
    texcoord = v.texcoord;
    color = unpackUnorm4x8(v.color);
    gl_Position = vec4(v.position * to_clip - 1.0, 0.0, 1.0);
}
