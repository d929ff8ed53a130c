// Punctual lights and the environment's spherical harmonics as one block, by address; mirrored by
// modules/light/light_data.h. Positions are relative to the camera. GLSL only.
#ifndef VELLUS_LIGHTS_GLSL
#define VELLUS_LIGHTS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "light/sh.glsl"

const uint kMaxLights = 4;
const uint kLightSun = 0;
const uint kLightSpot = 1;
const uint kNoShadow = 0xffffffffu;

layout(buffer_reference, scalar) readonly buffer HairDepths { uint at[]; };

struct PunctualLight {
    mat4 to_hair;         // position relative to the camera -> clip space of its map of hair
    mat4 to_opaque;       // the same for its tile of opaque casters
    vec3 position;        // of a spot or point
    uint kind;
    vec3 to_light;        // unit: towards a sun; against the axis of a spot
    float cone_scale;     // spot: saturate(cos * cone_scale + cone_offset)^2; point: 0 and 1
    vec3 color;           // sun: irradiance; spot: intensity, so irradiance at 1 m
    float cone_offset;
    uint shadow_tile;     // tile in the atlas of opaque casters, or kNoShadow
    float hair_texel;     // metres a texel covers: everywhere (sun), at 1 m (spot)
    float hair_range;     // metres: range of reversed depth (sun), near plane (spot)
    uint hair_size;       // texels along a side
    float opaque_texel;
    float opaque_range;
    uint opaque_size;
    uint layers_size;       // texels along a side of hair_layers
    HairDepths hair_depth;  // reversed depth of the closest hair, float bits, row by row; 0: no hair
    HairDepths hair_layers;  // optical depth by layer (hair/shadow/deep_opacity.glsl); 0: none
    float layers_span;       // metres from the first layer to the last one's end
    uint padding;
};

struct LightBlock {
    uint count;
    uint tiles;  // shadow tiles side by side in the atlas
    Sh9 environment;
    uint opaque_casters;  // 0: nothing is in the atlas
    PunctualLight light[4];
};
layout(buffer_reference, scalar) readonly buffer Lights { LightBlock block; };

/// Irradiance across the beam at `p`, and the unit direction towards the light.
vec3 light_irradiance(PunctualLight light, vec3 p, out vec3 to_light) {
    if (light.kind == kLightSun) {
        to_light = light.to_light;
        return light.color;
    }
    vec3 d = light.position - p;
    float squared = max(dot(d, d), 1.0e-4);
    to_light = d * inversesqrt(squared);
    float cone = saturate(dot(to_light, light.to_light) * light.cone_scale + light.cone_offset);
    return light.color * (cone * cone / squared);
}

/// Distance from the light, in metres, of a reversed depth in a map of this range; empty (0) is beyond
/// everything.
float shadow_metres(PunctualLight light, float range, float depth) {
    return light.kind == kLightSun ? (depth > 0.0 ? (1.0 - depth) * range : 1.0e30)
                                   : range / max(depth, 1.0e-30);
}

vec4 shadow_metres(PunctualLight light, float range, vec4 depth) {
    return vec4(shadow_metres(light, range, depth.x), shadow_metres(light, range, depth.y),
                shadow_metres(light, range, depth.z), shadow_metres(light, range, depth.w));
}

/// Size in metres of a texel, `texel` as in PunctualLight, at this distance from the light.
float shadow_texel_metres(PunctualLight light, float texel, float metres) {
    return light.kind == kLightSun ? texel : texel * metres;
}

/// uv in [0, 1]^2 of the map behind `to_map` and reversed depth; false outside the map.
bool shadow_position(mat4 to_map, vec3 p, out vec2 uv, out float depth) {
    vec4 clip = to_map * vec4(p, 1.0);
    if (clip.w <= 0.0) return false;
    uv = clip.xy / clip.w * 0.5 + 0.5;
    depth = clip.z / clip.w;
    return all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0))) && depth > 0.0;
}

#endif
