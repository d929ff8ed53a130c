#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/geometry/strands.glsl"

// Each point of a groom to pixels, depth and width in pixels, once per view or light.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    mat4 to_clip;
    Vec3s positions;
    Uints parameters;
    Floats widths;
    ProjectedPoints projected;
    vec2 viewport;
    uint point_count;
    float width;             // metres; 0: from the column
    float tip_scale;         // width left at the tip
    float pixels_per_metre;  // at w = 1
};

void main() {
    uint i = thread_index();
    if (i >= point_count) return;
    vec4 clip = to_clip * vec4(positions.at[i], 1.0);
    bool visible = clip.w > 0.0 && clip.z <= clip.w;
    float inverse_w = visible ? 1.0 / clip.w : 0.0;
    vec2 pixel = (clip.xy * inverse_w * 0.5 + 0.5) * viewport;
    float metres = width > 0.0 ? width : widths.at[i];
    metres *= mix(1.0, tip_scale, point_parameter(parameters, i));
    projected.at[i] = vec4(pixel, clip.z * inverse_w,
                           visible ? metres * pixels_per_metre * inverse_w : -1.0);
}
