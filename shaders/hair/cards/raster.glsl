// Walks a card's triangle on the screen, row by row, and looks its atlas up. Several threads may share a
// triangle's rows: one for small ones, which then pay the set-up once, more for large ones. The includer
// defines `bool hidden(ivec2 pixel, float depth)`: whether something nearer is there already, and
// `void fragment(ivec2 pixel, CardFragment at)`; it includes cards.glsl before.

/// What changes evenly over a triangle's pixels.
struct CardValues {
    vec4 place;  // uv / w, 1 / w, depth
    vec4 look;   // depth per unit of the atlas's depth, its size, alpha factor, optical depth factor
};

CardValues card_values(CardSet set, CardVertices vertices, CardTriangle triangle, vec3 weights) {
    CardValues values = CardValues(vec4(0.0), vec4(0.0));
    for (int i = 0; i < 3; ++i) {
        CardVertex vertex = vertices.at[triangle.points[i]];
        float w = vertex.position.w;
        values.place += weights[i] * vec4(set.uvs.at[triangle.points[i]] * w, w, vertex.screen.z);
        values.look += weights[i] * vec4(vertex.screen.w, abs(vertex.screen.w), vertex.toward.w,
                                         vertex.across.w);
    }
    return values;
}

/// Share of an area that is covered where `opacity` of it is and the strands stand `density` times as
/// close: optical depth is additive.
float card_alpha(float opacity, float density) {
    return opacity >= 1.0 ? 1.0 : 1.0 - exp2(log2(1.0 - opacity) * density);
}

void card_pixel(CardSet set, CardTriangle triangle, CardValues values, ivec2 pixel) {
    if (hidden(pixel, values.place.w + values.look.y)) return;
    uint texel = card_texel(triangle, values.place.xy / values.place.z);
    uint shape = set.shape.at[texel];
    if ((shape & 0xffu) == 0u) return;
    CardFragment at;
    at.depth = values.place.w + card_depth(shape) * values.look.x;
    at.alpha = card_alpha(card_opacity(shape), values.look.w) * values.look.z;
    at.seed = card_seed(shape, triangle.salt);
    at.texel = texel;
    at.opacity = card_opacity(shape);
    at.density = values.look.w * values.look.z;
    fragment(pixel, at);
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

void walk_card_triangle(CardSet set, CardVertices vertices, uint index, uint thread, uint threads,
                        ivec2 size) {
    CardTriangle triangle = card_triangle(set, vertices, index);
    if (triangle.inverse_area == 0.0) return;
    vec2 ys = vec2(triangle.corner.y) + vec2(min(min(triangle.edge1.y, triangle.edge2.y), 0.0),
                                             max(max(triangle.edge1.y, triangle.edge2.y), 0.0));
    int first = int(clamp(ceil(ys.x - 0.5), 0.0, float(size.y)));
    int end = int(clamp(ceil(ys.y - 0.5), 0.0, float(size.y)));
    if (first + int(thread) >= end) return;
    CardValues corner = card_values(set, vertices, triangle, vec3(1.0, 0.0, 0.0));
    vec2 to_b = vec2(triangle.edge2.y, -triangle.edge2.x) * triangle.inverse_area;
    vec2 to_c = vec2(-triangle.edge1.y, triangle.edge1.x) * triangle.inverse_area;
    CardValues right = card_values(set, vertices, triangle, vec3(-to_b.x - to_c.x, to_b.x, to_c.x));
    CardValues down = card_values(set, vertices, triangle, vec3(-to_b.y - to_c.y, to_b.y, to_c.y));
    for (int y = first + int(thread); y < end; y += int(threads)) {
        ivec2 row = card_row(triangle, y, size.x);
        if (row.x >= row.y) continue;
        vec2 offset = vec2(row.x, y) + 0.5 - triangle.corner;
        CardValues values;
        values.place = corner.place + offset.x * right.place + offset.y * down.place;
        values.look = corner.look + offset.x * right.look + offset.y * down.look;
        for (int x = row.x; x < row.y; ++x) {
            card_pixel(set, triangle, values, ivec2(x, y));
            values.place += right.place;
            values.look += right.look;
        }
    }
}
