// What shading needs of the card under a pixel; the counterpart of hair_sample. GLSL only.
#ifndef VELLUS_HAIR_CARD_SAMPLE_GLSL
#define VELLUS_HAIR_CARD_SAMPLE_GLSL
#include "hair/cards/cards.glsl"
#include "hair/geometry/instance.glsl"

vec3 card_color(uint srgb) {
    vec3 c = vec3(srgb & 0xffu, (srgb >> 8) & 0xffu, (srgb >> 16) & 0xffu) * (1.0 / 255.0);
    return mix(c * (1.0 / 12.92), pow((c + 0.055) * (1.0 / 1.055), vec3(2.4)),
               greaterThan(c, vec3(0.04045)));
}

/// From where a tube shows its point to where that lies in the atlas, which faces the card: the tube's
/// cross-section, a disc once its half axes are divided out, turns. In texture coordinates.
float card_turn(vec4 turn, float depth) {
    return turn.w * (clamp(turn.x * turn.y - depth * turn.z, -1.0, 1.0) - turn.x);
}

HairSample card_sample(HairInstance hair, CardSet set, CardVertices vertices, uint index, vec2 pixel) {
    CardTriangle triangle = card_triangle(set, vertices, index);
    vec3 weights = card_weights(triangle, card_screen_weights(triangle, pixel));
    vec3 position = vec3(0.0), toward = vec3(0.0), along = vec3(0.0), across = vec3(0.0);
    vec4 turn = vec4(0.0);
    vec2 uv = vec2(0.0);
    float parameter = 0.0;
    for (int i = 0; i < 3; ++i) {
        CardVertex vertex = vertices.at[triangle.points[i]];
        position += weights[i] * vertex.position.xyz;
        toward += weights[i] * vertex.toward.xyz;
        along += weights[i] * vertex.along.xyz;
        across += weights[i] * vertex.across.xyz;
        turn += weights[i] * vertex.turn;
        parameter += weights[i] * vertex.along.w;
        uv += weights[i] * set.uvs.at[triangle.points[i]];
    }
    uint texel = card_texel(triangle, uv);
    uint shape = set.shape.at[texel];
    float depth = card_depth(shape);
    uint seen = card_texel(triangle, uv + vec2(card_turn(turn, depth), 0.0));
    uint strand = set.strand.at[seen];
    vec3 in_card = vec3(card_signed(strand), card_signed(strand >> 8), card_signed(strand >> 16));

    HairSample result;
    result.position = position + depth * toward;
    result.tangent = in_card.x * across + in_card.y * along + in_card.z * cross(across, along);
    if (dot(result.tangent, result.tangent) < 1.0e-6) result.tangent = along;
    result.parameter = (set.flags & kCardsParameters) != 0u ? float(strand >> 24) * (1.0 / 255.0)
                                                            : parameter;
    result.along = 0.0;
    result.ambient = AmbientDepths(vec3(0.0), vec3(0.0), vec3(1.0), vec3(1.0));
    if (uint64_t(hair.ambient) != 0ul) {
        vec3 along_steps = vec3(0.0), against_steps = vec3(0.0);
        vec3 along_open = vec3(0.0), against_open = vec3(0.0);
        for (int i = 0; i < 3; ++i) {
            uvec2 words = hair.ambient.at[triangle.points[i]];
            along_steps += weights[i] * ambient_steps(words.x);
            against_steps += weights[i] * ambient_steps(words.y);
            along_open += weights[i] * ambient_open(words.x);
            against_open += weights[i] * ambient_open(words.y);
        }
        result.ambient = AmbientDepths(ambient_depth(along_steps), ambient_depth(against_steps),
                                       along_open, against_open);
    }
    result.seed = card_seed(shape, triangle.salt);
    result.tint = (set.flags & kCardsColors) != 0u ? card_color(set.color.at[seen]) : vec3(1.0);
    return result;
}

/// From where that point is to where it was last frame; for grooms whose points move. A tube that turns
/// with the eye has no points of its own, so it moves as its rows do.
vec3 card_previous_offset(HairInstance hair, CardSet set, CardVertices vertices, uint index, vec2 pixel) {
    CardTriangle triangle = card_triangle(set, vertices, index);
    vec3 weights = card_weights(triangle, card_screen_weights(triangle, pixel));
    vec3 offset = vec3(0.0);
    for (int i = 0; i < 3; ++i) {
        uint point = triangle.points[i];
        if ((set.flags & kCardsRibbons) != 0u) {
            point -= point % 3u;
            offset += 0.5 * weights[i] * (hair.previous_positions.at[point + 1u] -
                                          hair.positions.at[point + 1u]);
            weights[i] *= 0.5;
        }
        offset += weights[i] * (hair.previous_positions.at[point] - hair.positions.at[point]);
    }
    return offset;
}

#endif
