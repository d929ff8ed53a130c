#include "common/hair_mark.glsl"
#include "common/view.glsl"
#include "hair/cards/sample.glsl"
#include "hair/geometry/instance.glsl"
#include "hair/scattering/scattering.glsl"
#include "hair/shadow/hair_shadow.glsl"
#include "light/opaque_shadow.glsl"

// The stage of pass hair/shade. A technique from outside the module includes it after defining
// VELLUS_HAIR_BSDF (hair/scattering/scattering.glsl).
//
// Shades the pixels whose closest visible segment belongs to one groom and puts them over what is
// behind. What all pixels share comes from uniform blocks at fixed offsets, and what this groom or
// frame does not call for is compiled out.
//
// A group first lists the pixels of its tile that the groom is in, then shades those: few tiles are full of hair.
const int kTile = 32;
layout(local_size_x = 32) in;
layout(constant_id = 0) const uint kLightCount = 4;
layout(constant_id = 1) const int kShadow = 1;  // as ShadowTechnique of modules/hair/techniques.h
layout(constant_id = 2) const int kEnvironment = 1;  // as EnvironmentTechnique there
layout(constant_id = 3) const bool kOpaqueCasters = true;
layout(constant_id = 5) const int kScattering = 0;
layout(constant_id = 6) const int kMultiple = 1;
layout(constant_id = 4) const bool kDeformed = false;  // its points move by themselves
layout(constant_id = 7) const bool kCards = false;

layout(push_constant, scalar) uniform Push {
    LongWords visibility;
    ProjectedPoints projected;  // CardVertices where the groom is of cards
    uint first_id;
    uint segment_count;
    ivec2 first_pixel;  // of the rectangle that holds the groom
    ivec2 end_pixel;
    int width;  // of the picture
    uint padding;
};
layout(binding = 0) uniform sampler2D opaque_depth;
layout(binding = 1) uniform sampler2D opaque_shadows;
layout(binding = 2, rgba16f) uniform writeonly image2D color;
layout(binding = 3, rg16f) uniform writeonly image2D velocity;
layout(binding = 4, scalar) uniform Views { View view; };
layout(binding = 5, scalar) uniform LightsBlock { LightBlock lights; };
layout(binding = 6, scalar) uniform Instance { HairInstance hair; };
// Where the techniques need no fibre, something else is bound and nothing read.
layout(binding = 7, scalar) uniform Fibre { HairFibre fibre; };

/// Of the light, what passes the hair in front; `opaque` is what passes everything else and `behind` the
/// optical depth of the hair behind.
float shadow_of(PunctualLight light, vec3 position, out float opaque, out float behind) {
    opaque = 1.0;
    behind = kDualMostFibres;
    if (kShadow == 0 || light.shadow_tile == kNoShadow) return 1.0;
    float texel = shadow_texel_metres(light, light.hair_texel, light.kind == kLightSun
                                                 ? 1.0
                                                 : distance(light.position, position));
    if (kOpaqueCasters) opaque = opaque_visibility(opaque_shadows, light, position);
    if (kShadow == 2) {
        DeepPoint at = deep_point(light, position, hair.width);
        if (kMultiple == kMultipleDual && deep_knows(at)) behind = deep_behind(light, at);
        return deep_transmittance(light, at);
    }
    return hair_transmittance(light, position, hair.shadow_falloff, hair.shadow_first + texel);
}

vec3 shade(HairSurface surface, vec3 position, vec3 tangent, AmbientDepths ambient) {
    HairFrame frame = hair_frame(tangent, normalize(-position));
    HairEye eye = hair_eye(fibre, frame);
    vec3 radiance = vec3(0.0);
    [[unroll]] for (uint i = 0u; i < kLightCount; ++i) {
        vec3 to_light;
        vec3 irradiance = light_irradiance(lights.light[i], position, to_light);
        float opaque;
        float behind;
        float shadow = shadow_of(lights.light[i], position, opaque, behind);
        radiance += irradiance * opaque * hair_direct(kScattering, kMultiple, fibre, surface, frame, eye,
                                             to_light, shadow, behind);
    }
    if (kEnvironment == 2) {
        mat3 axes = mat3(hair.ambient_axes[0], hair.ambient_axes[1], hair.ambient_axes[2]);
        ambient.along *= hair.ambient_scale;
        ambient.against *= hair.ambient_scale;
        radiance += hair_ambient(fibre, surface, frame, tangent, axes, lights.environment,
                                 hair.ambient_light, ambient);
    }
    if (kEnvironment == 1) {
        radiance += karis_environment(surface, frame,
                                      sh_irradiance_over_pi(lights.environment, frame.normal));
    }
    return radiance;
}

uint64_t key_of(ivec2 pixel) { return visibility.at[pixel.y * width + pixel.x]; }

uint segment_of(uint64_t key) { return uint(key & 0xffffffffUL) - 1u - first_id; }

bool is_seen(ivec2 pixel) {
    if (any(greaterThanEqual(pixel, end_pixel))) return false;
    uint64_t key = key_of(pixel);
    if (segment_of(key) >= segment_count) return false;
    return texelFetch(opaque_depth, pixel, 0).x < uintBitsToFloat(uint(key >> 32));
}

void shade_pixel(ivec2 pixel) {
    uint segment = segment_of(key_of(pixel));
    vec2 center = vec2(pixel) + 0.5;
    HairSample at;
    vec3 previous;
    if (kCards) {
        CardSet cards = Cards(hair.cards).set;
        CardVertices vertices = CardVertices(uint64_t(projected));
        at = card_sample(hair, cards, vertices, segment, center);
        previous = at.position;
        if (kDeformed) previous += card_previous_offset(hair, cards, vertices, segment, center);
    } else {
        at = hair_sample(hair, projected, segment, center);
        previous = kDeformed ? hair_previous_position(hair, at, segment) : at.position;
    }
    HairSurface surface = HairSurface(hair_color(hair, at), hair.specular, hair.roughness,
                                      hair.scatter, hair.shift);
    vec3 position = (hair.to_relative * vec4(at.position, 1.0)).xyz;
    vec3 tangent = normalize(mat3(hair.to_relative) * at.tangent);
    vec3 radiance = shade(surface, position, tangent, at.ambient);
    imageStore(color, pixel, vec4(min(radiance, vec3(60000.0)), kHairMark));

    vec4 before = hair.previous_to_clip * vec4(previous, 1.0);
    vec2 moved = view.cut != 0u || before.w <= 0.0
                     ? vec2(0.0)
                     : view_velocity(view, hair.to_clip * vec4(at.position, 1.0), before);
    imageStore(velocity, pixel, vec4(moved, 0.0, 0.0));
}

shared uint seen_count;
shared uint seen[kTile * kTile];  // pixels of the tile, row by row

void main() {
    ivec2 corner = first_pixel + ivec2(gl_WorkGroupID.xy) * kTile;
    if (gl_LocalInvocationIndex == 0u) seen_count = 0u;
    barrier();
    for (uint row = 0u; row < kTile; ++row) {
        if (!is_seen(corner + ivec2(gl_LocalInvocationIndex, row))) continue;
        seen[atomicAdd(seen_count, 1u)] = row * kTile + gl_LocalInvocationIndex;
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < seen_count; i += gl_WorkGroupSize.x) {
        shade_pixel(corner + ivec2(seen[i] % kTile, seen[i] / kTile));
    }
}
