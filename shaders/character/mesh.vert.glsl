#version 460
#extension GL_GOOGLE_include_directive : require
#include "character/mesh_push.glsl"

// Projects a vertex that skin.comp.glsl has placed.
layout(constant_id = 2) const bool kCovered = false;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_texcoord;
layout(location = 3) out vec4 out_color;
layout(location = 4) out vec3 out_previous_clip;  // x, y, w
layout(location = 5) out vec3 out_sky_share;
layout(location = 6) out vec3 out_sky_lean;

void main() {
    uint i = gl_VertexIndex;
    SkinnedVertex v = vertices.at[i];
    gl_Position = view.view_projection * vec4(v.position, 1.0);
    vec4 previous_clip = view.previous_view_projection * vec4(v.previous, 1.0);
    out_position = v.position;
    out_normal = v.normal;
    out_previous_clip = previous_clip.xyw;
    out_texcoord = uint64_t(texcoords) != 0ul ? texcoords.at[i] : vec2(0.0);
    if (kCovered) {
        out_sky_share = covers.at[i].share;
        out_sky_lean = covers.at[i].lean;
    }
    out_color = uint64_t(colors) != 0ul ? colors.at[i] : vec4(1.0);
}
