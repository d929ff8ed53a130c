#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/cards/cards.glsl"
#include "hair/shadow/deep_add.glsl"

// Cards into the layers of a light's deep opacity map: four texels of the shadow map share one there.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    Cards cards;
    CardVertices vertices;
    DeepTarget target;
    float alpha_scale;
    uint threads;  // that share a triangle
    uint triangle_count;
};

bool hidden(ivec2 texel, float depth) { return false; }

CardSet set;

void fragment(ivec2 texel, CardFragment at) {
    float fibres = card_fibres(set, at.texel, at.opacity) * at.density;
    deep_add_fibres(target, texel >> 1, at.depth, 0.25 * alpha_scale * fibres);
}

#include "hair/cards/raster.glsl"

void main() {
    uint triangle = thread_index() / threads;
    if (triangle >= triangle_count) return;
    set = cards.set;
    walk_card_triangle(set, vertices, triangle, thread_index() % threads, threads,
                       ivec2(2 * target.size));
}
