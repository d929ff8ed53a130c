#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "character/mesh_push.glsl"
#include "common/pbr.glsl"
#include "hair/shadow/hair_shadow.glsl"
#include "light/opaque_shadow.glsl"

// Metallic-roughness surface under punctual lights with their shadows and the environment's SH. A CPU
// device runs both sides of a branch, so what this frame does not call for is compiled out.
layout(constant_id = 0) const uint kLightCount = 4;
layout(constant_id = 1) const int kHairShadows = 1;  // HairOnMeshes of modules/character/mesh_library.h

layout(constant_id = 2) const bool kCovered = false;  // something keeps the sky from this primitive

layout(set = 0, binding = 0) uniform sampler2D base_color_image;
layout(set = 0, binding = 1) uniform sampler2D opaque_shadows;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in vec4 color;
layout(location = 4) in vec3 previous_clip;
layout(location = 5) in vec3 sky_share;
layout(location = 6) in vec3 sky_lean;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec2 out_velocity;

bool is_cut_out(float alpha) {
    if (alpha_cutoff > 0.0) return alpha < alpha_cutoff;
    if (alpha_cutoff == 0.0) return false;
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint mixed = hash_uint(pixel.x + hash_uint(pixel.y + hash_uint(view.frame_index)));
    return alpha <= unit_float(mixed);
}

float shadow(PunctualLight light, vec3 n, vec3 to_light) {
    float distance = light.kind == kLightSun ? 1.0 : length(light.position - position);
    vec3 p =
        position + shadow_normal_offset(n, to_light, shadow_texel_metres(light, light.opaque_texel, distance));
    float visible = opaque_visibility(opaque_shadows, light, p);
    if (kHairShadows == 0) return visible;
    // As the hair itself does: by how much of it is in front, where layers hold that.
    if (kHairShadows == 2) return visible > 0.0 ? visible * deep_transmittance(light, deep_point(light, p, 0.0)) : 0.0;
    return visible > 0.0 ? visible * hair_transmittance(light, p, hair_falloff, 0.0) : 0.0;
}

void main() {
    vec4 base = base_color * color * texture(base_color_image, texcoord);
    if (is_cut_out(base.a)) discard;
    PbrSurface surface;
    surface.base_color = base.rgb;
    surface.metallic = metallic;
    surface.roughness = roughness;
    vec3 n = normalize(normal) * (gl_FrontFacing ? front_flip : back_flip);
    vec3 to_view = -normalize(position);
    vec3 radiance = emissive;
    [[unroll]] for (uint i = 0; i < kLightCount; ++i) {
        PunctualLight light = lights.light[i];
        vec3 to_light;
        vec3 irradiance = light_irradiance(light, position, to_light);
        vec3 reflected = pbr_direct(surface, n, to_light, to_view) * irradiance;
        if (max(max(reflected.r, reflected.g), reflected.b) > 0.0) {
            radiance += reflected * shadow(light, n, to_light);
        }
    }
    vec3 sky = pbr_environment(surface, dot(n, to_view),
                               sh_irradiance_over_pi(lights.environment, kCovered ? normalize(n + sky_lean) : n),
                               sh_irradiance_over_pi(lights.environment, reflect(-to_view, n)));
    radiance += kCovered ? sky * sky_share : sky;
    out_color = vec4(min(radiance, vec3(60000.0)), 1.0);
    vec2 pixel = gl_FragCoord.xy - view.jitter;
    vec2 previous = (previous_clip.xy / previous_clip.z * 0.5 + 0.5) * vec2(view.size);
    out_velocity = pixel - previous;
}
