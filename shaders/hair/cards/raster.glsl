// Walks a card's triangle on the screen, a thread a row of pixels, and looks its atlas up. The includer
// defines `void fragment(ivec2 pixel, float depth, float alpha, uint seed)`.
#include "hair/cards/cards.glsl"

/// What a triangle's pixels need of its vertices.
struct CardSpan {
    CardTriangle triangle;
    vec3 depth;
    vec3 depth_step;
    vec3 alpha;
    vec3 density;
    vec2 uv[3];
};

CardSpan card_span(CardSet set, CardVertices vertices, CardTriangle triangle) {
    CardSpan span;
    span.triangle = triangle;
    for (int i = 0; i < 3; ++i) {
        CardVertex vertex = vertices.at[triangle.points[i]];
        span.depth[i] = vertex.screen.z;
        span.depth_step[i] = vertex.screen.w;
        span.alpha[i] = vertex.toward.w;
        span.density[i] = vertex.across.w;
        span.uv[i] = set.uvs.at[triangle.points[i]];
    }
    return span;
}

/// Share of an area that is covered where `opacity` of it is and the strands stand `density` times as
/// close: optical depth is additive.
float card_alpha(float opacity, float density) {
    return opacity >= 1.0 ? 1.0 : 1.0 - exp2(log2(1.0 - opacity) * density);
}

void card_pixel(CardSet set, CardSpan span, ivec2 pixel) {
    vec3 on_screen = card_screen_weights(span.triangle, vec2(pixel) + 0.5);
    vec3 weights = card_weights(span.triangle, on_screen);
    vec2 uv = span.uv[0] * weights.x + span.uv[1] * weights.y + span.uv[2] * weights.z;
    uint shape = set.shape.at[card_texel(set, uv, span.triangle.level)];
    if ((shape & 0xffu) == 0u) return;
    float alpha = card_alpha(card_opacity(shape), dot(span.density, weights)) *
                  dot(span.alpha, weights);
    float depth = dot(span.depth, on_screen) + card_depth(shape) * dot(span.depth_step, on_screen);
    fragment(pixel, depth, alpha, card_seed(shape));
}

/// Pixels of row `y` whose centres lie in the triangle: first, and end (not included).
ivec2 card_row(CardTriangle triangle, int y, int width) {
    vec2 a = triangle.corner, b = a + triangle.edge1, c = a + triangle.edge2;
    vec2 edges[4] = vec2[](a, b, c, a);
    float row = float(y) + 0.5, low = 1.0e9, high = -1.0e9;
    for (int i = 0; i < 3; ++i) {
        vec2 p = edges[i], q = edges[i + 1];
        if ((p.y > row) == (q.y > row)) continue;
        float x = p.x + (row - p.y) * (q.x - p.x) / (q.y - p.y);
        low = min(low, x);
        high = max(high, x);
    }
    // Half open like the rows: a pixel between two triangles belongs to one of them.
    return ivec2(clamp(ceil(vec2(low, high) - 0.5), vec2(0.0), vec2(float(width))));
}

void walk_card_triangle(CardSet set, CardVertices vertices, uint triangle, uint thread, uint threads,
                        ivec2 size) {
    CardTriangle t = card_triangle(set, vertices, triangle);
    if (t.inverse_area == 0.0) return;
    vec2 ys = vec2(t.corner.y) + vec2(min(min(t.edge1.y, t.edge2.y), 0.0),
                                      max(max(t.edge1.y, t.edge2.y), 0.0));
    int first = int(clamp(ceil(ys.x - 0.5), 0.0, float(size.y)));
    int end = int(clamp(ceil(ys.y - 0.5), 0.0, float(size.y)));
    if (first >= end) return;
    CardSpan span = card_span(set, vertices, t);
    for (int y = first + int(thread); y < end; y += int(threads)) {
        ivec2 row = card_row(t, y, size.x);
        for (int x = row.x; x < row.y; ++x) card_pixel(set, span, ivec2(x, y));
    }
}
