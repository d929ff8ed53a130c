// A groom as this frame draws it; mirrored by modules/hair/geometry/hair_instance.h. GLSL only.
#ifndef VELLUS_HAIR_INSTANCE_GLSL
#define VELLUS_HAIR_INSTANCE_GLSL
#include "common/portable.glsl"
#include "hair/environment/ambient.glsl"
#include "hair/geometry/strands.glsl"

const uint kHairHasColors = 1u;

struct HairInstance {
    mat4 to_relative;       // groom to metres relative to the camera
    mat4 to_clip;           // groom to clip space, not jittered
    mat4 previous_to_clip;  // the same last frame
    Vec3s positions;
    Vec3s previous_positions;  // last frame's; the same where the groom is rigid
    Uints parameters;
    Uvec2s colors;
    Uints segment_point;
    Uints segment_strand;
    Uints strand_seed;
    uint64_t cards;      // address of a CardSet (hair/cards/cards.glsl); 0 for strands
    Uvec2s ambient;      // optical depths around its points (hair/environment/ambient.glsl); 0: unknown
    uint first_point;    // of its points among all projected ones
    uint flags;
    vec3 base_color;
    float color_variation;
    vec3 tip_color;
    float gradient_start;
    float specular;
    float roughness;
    float scatter;
    float shift;
    float shadow_falloff;  // 1/m
    float shadow_first;    // metres of hair without self-shadow, besides the map's texels
    float width;           // of its strands on average, metres
    float ambient_scale;   // from the depths there to those of strands as wide as these
    vec3 ambient_axes[3];  // the groom's axes in the world
    AmbientLight ambient_light;  // along these axes
    uint padding;
};

/// A point of a strand under a pixel.
struct HairSample {
    vec3 position;  // groom space
    vec3 tangent;   // groom space, root to tip, not unit
    float parameter;
    float along;  // from the segment's first point to its second, in [0, 1]
    uint seed;    // of its strand
    vec3 tint;    // the groom's own colour; white without
    AmbientDepths ambient;  // in strands of nominal width
};

/// Optical depths around a point between i and i + 1.
AmbientDepths hair_ambient_depths(HairInstance hair, uint i, float along) {
    if (uint64_t(hair.ambient) == 0ul) return AmbientDepths(vec3(0.0), vec3(0.0), vec3(1.0), vec3(1.0));
    uvec2 a = hair.ambient.at[i], b = hair.ambient.at[i + 1u];
    return AmbientDepths(ambient_depth(mix(ambient_steps(a.x), ambient_steps(b.x), along)),
                         ambient_depth(mix(ambient_steps(a.y), ambient_steps(b.y), along)),
                         mix(ambient_open(a.x), ambient_open(b.x), along),
                         mix(ambient_open(a.y), ambient_open(b.y), along));
}

/// Where pixel centre `pixel` meets the segment: positions perspective-correct, tangents smooth along
/// the strand.
HairSample hair_sample(HairInstance hair, ProjectedPoints projected, uint segment, vec2 pixel) {
    uint i = hair.segment_point.at[segment];
    vec4 a = projected.at[hair.first_point + i], b = projected.at[hair.first_point + i + 1u];
    vec2 along = b.xy - a.xy;
    float t = clamp(dot(pixel - a.xy, along) / max(dot(along, along), 1.0e-12), 0.0, 1.0);
    t = t * b.z / max(mix(a.z, b.z, t), 1.0e-30);

    float u0 = point_parameter(hair.parameters, i), u1 = point_parameter(hair.parameters, i + 1u);
    vec3 p0 = hair.positions.at[i], p1 = hair.positions.at[i + 1u];
    vec3 direction = p1 - p0;
    // Root and tip have the parameters 0 and 1; elsewhere the neighbours belong to the same strand.
    vec3 t0 = u0 > 0.0 ? p1 - hair.positions.at[i - 1u] : direction;
    vec3 t1 = u1 < 1.0 ? hair.positions.at[i + 2u] - p0 : direction;

    HairSample result;
    result.position = mix(p0, p1, t);
    result.tangent = mix(t0 * inversesqrt(max(dot(t0, t0), 1.0e-20)),
                         t1 * inversesqrt(max(dot(t1, t1), 1.0e-20)), t);
    if (dot(result.tangent, result.tangent) < 1.0e-6) result.tangent = direction;
    result.parameter = mix(u0, u1, t);
    result.along = t;
    result.ambient = hair_ambient_depths(hair, i, t);
    result.seed = hair.strand_seed.at[hair.segment_strand.at[segment]];
    result.tint = vec3(1.0);
    if ((hair.flags & kHairHasColors) != 0u) {
        uvec2 halves = hair.colors.at[i];
        result.tint = vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
    }
    return result;
}

/// Where that point was last frame; for grooms whose points move.
vec3 hair_previous_position(HairInstance hair, HairSample at, uint segment) {
    uint i = hair.segment_point.at[segment];
    return mix(hair.previous_positions.at[i], hair.previous_positions.at[i + 1u], at.along);
}

/// Base colour there: gradient from root to tip, the groom's own colours, brightness by strand.
vec3 hair_color(HairInstance hair, HairSample at) {
    float along = clamp((at.parameter - hair.gradient_start) / max(1.0 - hair.gradient_start, 1.0e-3),
                        0.0, 1.0);
    vec3 color = mix(hair.base_color, hair.tip_color, along);
    if ((hair.flags & kHairHasColors) != 0u) color *= at.tint;
    float random = unit_float(hash_uint(at.seed ^ 0x5bd1e995u));
    return clamp(color * (1.0 + hair.color_variation * (2.0 * random - 1.0)), 0.0, 1.0);
}

#endif
