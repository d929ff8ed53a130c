// Columns of a card groom on the device, by address, and how its atlas is read. GLSL only; mirrored by
// modules/hair/cards/card_buffers.h.
#ifndef VELLUS_HAIR_CARDS_GLSL
#define VELLUS_HAIR_CARDS_GLSL
#include "common/portable.glsl"
#include "hair/geometry/strands.glsl"
#include "hair/shadow/deep_opacity.glsl"

const uint kCardsRibbons = 1u;
const uint kCardsColors = 2u;
const uint kCardsParameters = 4u;  // the atlas holds root to tip; else the vertices' does
const uint kCardsApart = 8u;       // no strand map, or several cards on one place of the atlas
const uint kCardLevels = 5u;       // of the atlas, each half as large as the one before

layout(buffer_reference, scalar) readonly buffer Vec2s { vec2 at[]; };
layout(buffer_reference, scalar) readonly buffer Uvec4s { uvec4 at[]; };

// A card's vertex as one view sees it.
struct CardVertex {
    vec4 screen;    // pixels x and y, depth, change of depth per unit of the atlas's depth
    vec4 position;  // groom space; w: 1 / clip w, negative behind the near plane
    vec4 toward;    // groom space: what a unit of the atlas's depth adds; w: alpha factor
    vec4 along;     // unit, groom space, root to tip; w: parameter
    vec4 across;    // unit, groom space; w: optical depth factor
    vec4 turn;      // of a ribbon: its edge (-1 or 1), cosine and sine of its turn; w: half its width in the atlas
};
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer CardVertices { CardVertex at[]; };

// One card groom; what moves (points) comes apart.
struct CardSet {
    Vec2s uvs;
    Uvec4s triangles;  // three points and the card
    Uints parameters;
    Uvec4s frames;
    Vec3s directions;  // of each row of a ribbon: squares and products of its strands' unit tangents
    Uints shape;   // per texel: opacity, depth, strand (16 bits)
    Uints strand;  // per texel: tangent, parameter
    Uints fibres;  // strands over each other, 16 each, a byte a texel; null: by chance
    Uints color;   // per texel: sRGB
    uvec2 size;    // texels of level 0
    uint flags;
    float depth_range;
    uint point_count;
    uint triangle_count;
};
layout(buffer_reference, scalar) readonly buffer Cards { CardSet set; };

float card_opacity(uint shape) { return float(shape & 0xffu) * (1.0 / 255.0); }
float card_signed(uint code) { return max((float(code & 0xffu) - 128.0) * (1.0 / 127.0), -1.0); }
float card_depth(uint shape) { return card_signed(shape >> 8); }
uint card_seed(uint shape, uint card_salt) { return hash_uint((shape >> 16) + 1u + card_salt); }

/// A pixel of a card.
struct CardFragment {
    float depth;
    float alpha;
    uint seed;
    uint texel;     // of the atlas
    float opacity;  // there
    float density;  // fibres here to those of the texel
};

/// Three vertices, what makes the screen's plane of them, and the level of the atlas that suits.
struct CardTriangle {
    uvec3 points;
    vec2 corner;    // of the first vertex, pixels
    vec2 edge1;
    vec2 edge2;
    float inverse_area;  // of the parallelogram; 0: nothing to draw
    vec3 inverse_w;
    uint first_texel;  // of its level
    uvec2 level_size;
    uint salt;  // of its card's seeds
};

CardTriangle card_triangle(CardSet set, CardVertices vertices, uint triangle) {
    CardTriangle result;
    uvec4 joined = set.triangles.at[triangle];
    result.points = joined.xyz;
    result.salt = (set.flags & kCardsApart) != 0u ? joined.w * 0x9E3779B9u : 0u;
    vec4 a = vertices.at[result.points.x].screen;
    vec4 b = vertices.at[result.points.y].screen;
    vec4 c = vertices.at[result.points.z].screen;
    result.corner = a.xy;
    result.edge1 = b.xy - a.xy;
    result.edge2 = c.xy - a.xy;
    float area = result.edge1.x * result.edge2.y - result.edge1.y * result.edge2.x;
    result.inverse_w = vec3(vertices.at[result.points.x].position.w,
                            vertices.at[result.points.y].position.w,
                            vertices.at[result.points.z].position.w);
    bool visible = all(greaterThan(result.inverse_w, vec3(0.0))) && abs(area) > 1.0e-6;
    result.inverse_area = visible ? 1.0 / area : 0.0;
    vec2 uv = set.uvs.at[result.points.x];
    vec2 uv1 = set.uvs.at[result.points.y] - uv, uv2 = set.uvs.at[result.points.z] - uv;
    vec2 size = vec2(set.size);
    float texels = abs(uv1.x * uv2.y - uv1.y * uv2.x) * size.x * size.y;
    float level = 0.5 * log2(max(texels / max(abs(area), 1.0e-6), 1.0)) + 0.25;
    // Levels lie one after the other.
    result.first_texel = 0u;
    result.level_size = set.size;
    for (uint i = min(uint(level), kCardLevels - 1u); i > 0u; --i) {
        result.first_texel += result.level_size.x * result.level_size.y;
        result.level_size = max(result.level_size >> 1u, uvec2(1u));
    }
    return result;
}

/// Index of a texel in `shape`, `strand` and `color`.
uint card_texel(CardTriangle triangle, vec2 uv) {
    uvec2 size = triangle.level_size;
    uvec2 texel = min(uvec2(clamp(uv, 0.0, 1.0) * vec2(size)), size - 1u);
    return triangle.first_texel + texel.y * size.x + texel.x;
}

/// Strands over each other there, of which the texel's are `opacity` wide.
float card_fibres(CardSet set, uint texel, float opacity) {
    if (uint64_t(set.fibres) == 0ul) return deep_optical_depth_of(opacity);
    return float((set.fibres.at[texel >> 2u] >> (8u * (texel & 3u))) & 0xffu) * (1.0 / 16.0);
}

/// Weights of the vertices on the screen: what is linear there, such as depth.
vec3 card_screen_weights(CardTriangle triangle, vec2 pixel) {
    vec2 offset = pixel - triangle.corner;
    float b = (offset.x * triangle.edge2.y - offset.y * triangle.edge2.x) * triangle.inverse_area;
    float c = (triangle.edge1.x * offset.y - triangle.edge1.y * offset.x) * triangle.inverse_area;
    return vec3(1.0 - b - c, b, c);
}

/// Weights in space, from those on the screen.
vec3 card_weights(CardTriangle triangle, vec3 screen_weights) {
    vec3 weights = screen_weights * triangle.inverse_w;
    return weights / max(weights.x + weights.y + weights.z, 1.0e-30);
}

#endif
