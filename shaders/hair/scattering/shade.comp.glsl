#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "hair/geometry/instance.glsl"
#include "hair/scattering/karis.glsl"
#include "hair/shadow/hair_shadow.glsl"
#include "light/opaque_shadow.glsl"

// Shades the closest visible segment of each pixel and puts it over what is behind.
layout(local_size_x = 8, local_size_y = 8) in;
layout(buffer_reference, scalar) readonly buffer Views { View view; };
layout(push_constant, scalar) uniform Push {
    Views views;
    Lights lights;
    HairInstances instances;
    LongWords visibility;
    ProjectedPoints projected;
    uint instance_count;
    ivec2 size;
};
layout(binding = 0) uniform sampler2D opaque_depth;
layout(binding = 1) uniform sampler2D opaque_shadows;
layout(binding = 2, rgba16f) uniform writeonly image2D color;
layout(binding = 3, rg16f) uniform writeonly image2D velocity;

vec3 shade(HairInstance hair, HairSurface surface, vec3 position, vec3 tangent) {
    HairFrame frame = hair_frame(tangent, normalize(-position));
    vec3 radiance = vec3(0.0);
    for (uint i = 0u; i < lights.count; ++i) {
        PunctualLight light = lights.light[i];
        vec3 to_light;
        vec3 irradiance = light_irradiance(light, position, to_light);
        float shadow = 1.0;
        if ((hair.flags & kHairShadowed) != 0u && light.shadow_tile != kNoShadow) {
            float texel = light.kind == kLightSun ? light.shadow_texel
                                                  : light.shadow_texel * distance(light.position, position);
            shadow = hair_transmittance(light, position, hair.shadow_falloff,
                                        hair.shadow_first + texel);
            if (lights.opaque_casters > 0u) shadow *= opaque_visibility(opaque_shadows, light, position);
        }
        if (shadow > 0.0) radiance += irradiance * karis_direct(surface, frame, to_light, shadow);
    }
    if ((hair.flags & kHairEnvironment) != 0u) {
        radiance += karis_environment(surface, frame,
                                      sh_irradiance_over_pi(lights.environment, frame.normal));
    }
    return radiance;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    uint64_t key = visibility.at[pixel.y * size.x + pixel.x];
    uint id = uint(key & 0xffffffffUL);
    if (id == 0u) return;
    if (texelFetch(opaque_depth, pixel, 0).x >= uintBitsToFloat(uint(key >> 32))) return;

    uint index = 0u;
    while (index + 1u < instance_count && id > instances.at[index + 1u].first_id) ++index;
    HairInstance hair = instances.at[index];
    uint segment = id - hair.first_id - 1u;
    HairSample at = hair_sample(hair, projected, segment, vec2(pixel) + 0.5);
    HairSurface surface =
        HairSurface(hair_color(hair, at, segment), hair.specular, hair.roughness, hair.scatter, hair.shift);
    vec3 position = (hair.to_relative * vec4(at.position, 1.0)).xyz;
    vec3 tangent = normalize(mat3(hair.to_relative) * at.tangent);
    vec3 radiance = shade(hair, surface, position, tangent);
    imageStore(color, pixel, vec4(min(radiance, vec3(60000.0)), 1.0));

    View view = views.view;
    vec4 before = hair.previous_to_clip * vec4(at.position, 1.0);
    vec2 moved = view.cut != 0u || before.w <= 0.0
                     ? vec2(0.0)
                     : view_velocity(view, hair.to_clip * vec4(at.position, 1.0), before);
    imageStore(velocity, pixel, vec4(moved, 0.0, 0.0));
}
