// Walks a segment along its longer screen axis, one step a pixel: the strand covers an interval of
// the shorter axis there. Strands thinner than a pixel are drawn one pixel wide, alpha compensates.
// The includer defines `void fragment(ivec2 pixel, float depth, float coverage)`.

void walk_segment(vec4 a, vec4 b, ivec2 size) {
    if (a.w < 0.0 || b.w < 0.0) return;
    vec2 low = min(a.xy, b.xy) - max(a.w, b.w), high = max(a.xy, b.xy) + max(a.w, b.w);
    if (any(greaterThan(low, vec2(size))) || any(lessThan(high, vec2(0.0)))) return;

    vec2 span = abs(b.xy - a.xy);
    bool steep = span.y > span.x;
    if (steep) {
        a.xy = a.yx;
        b.xy = b.yx;
    }
    if (a.x > b.x) {
        vec4 c = a;
        a = b;
        b = c;
    }
    ivec2 limit = steep ? size.yx : size;
    // Half-open columns: a polyline crosses each column it spans exactly once.
    int first = max(int(ceil(a.x - 0.5)), 0);
    int last = min(int(ceil(b.x - 0.5)), limit.x);
    if (first >= last) return;
    vec4 slope = (b - a) / (b.x - a.x);
    float thickness = sqrt(1.0 + slope.y * slope.y);
    vec4 point = a + slope * (float(first) + 0.5 - a.x);
    for (int column = first; column < last; ++column, point += slope) {
        float width = point.w * thickness;
        float start = point.y - 0.5 * width, end = point.y + 0.5 * width;
        int row = int(floor(width > 1.0 ? start : point.y));
        int row_last = width > 1.0 ? int(floor(end)) : row;
        row = max(row, 0);
        row_last = min(row_last, limit.y - 1);
        for (; row <= row_last; ++row) {
            float coverage =
                width > 1.0 ? min(end, float(row + 1)) - max(start, float(row)) : width;
            fragment(steep ? ivec2(row, column) : ivec2(column, row), point.z, coverage);
        }
    }
}
