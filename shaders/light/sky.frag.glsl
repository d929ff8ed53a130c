#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/view.glsl"
#include "light/equirect.glsl"

// The environment image where nothing opaque was drawn, and how far it moved.
layout(push_constant, scalar) uniform Push {
    float intensity;
    float rotation_sin;
    float rotation_cos;
    float blur_lod;
};
layout(binding = 0) uniform sampler2D sky;
layout(binding = 1, scalar) uniform Views { View view; };
layout(location = 0) out vec4 color;
layout(location = 1) out vec2 velocity;

void main() {
    vec3 ray = view_ray(view, gl_FragCoord.xy);
    // The image turns counter-clockwise, so the direction looked up turns back.
    vec3 d = vec3(rotation_cos * ray.x - rotation_sin * ray.z, ray.y,
                  rotation_sin * ray.x + rotation_cos * ray.z);
    color = vec4(min(textureLod(sky, equirect_uv(d), blur_lod).rgb * intensity, vec3(60000.0)), 1.0);
    vec4 clip = view.view_projection_unjittered * vec4(ray, 0.0);
    vec4 before = view.previous_view_projection * vec4(ray, 0.0);
    velocity = view.cut != 0u || before.w <= 0.0 ? vec2(0.0) : view_velocity(view, clip, before);
}
