#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/cards/cards.glsl"

// Each vertex of a card groom as one view or light sees it.
//
// A ribbon stands for a tube of strands with an elliptic cross-section. Its drawn edges are the points of
// the ellipse where the line of sight touches it, so its silhouette is the tube's from every side: seen
// from its front the card lies flat in its own plane, seen from its edge it is as wide as it is thick.
// The conjugate half axis, along the line of sight, carries the atlas's depth.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    mat4 to_clip;
    vec4 eye;  // groom space: w 1 a position, w 0 a direction
    Cards cards;
    Vec3s points;
    CardVertices target;
    vec2 viewport;
};

CardSet set;

const float kMostDensity = 16.0;
const float kLeastHalfWidth = 0.5;  // pixels: nothing falls between the samples

vec3 direction_to_eye(vec3 p) { return normalize(eye.xyz - eye.w * p); }

/// Pixels, depth and 1/w (negative where not visible).
vec4 to_screen(vec3 p) {
    vec4 clip = to_clip * vec4(p, 1.0);
    bool visible = clip.w > 0.0 && clip.z <= clip.w;
    float inverse_w = visible ? 1.0 / clip.w : 0.0;
    return vec4((clip.xy * inverse_w * 0.5 + 0.5) * viewport, clip.z * inverse_w,
                visible ? inverse_w : -1.0);
}

/// Depth gained by a step of this many groom units towards the eye.
float depth_step(vec3 p, vec3 to_eye, float units, float depth) {
    vec4 clip = to_clip * vec4(p + to_eye * units, 1.0);
    return clip.w > 0.0 ? clip.z / clip.w - depth : 0.0;
}

void write_vertex(uint i, vec3 p, vec3 to_eye, vec3 toward, vec3 along, vec3 across, float alpha,
                  float density, vec4 turn) {
    vec4 screen = to_screen(p);
    CardVertex vertex;
    vertex.screen = vec4(screen.xyz, depth_step(p, to_eye, dot(toward, to_eye), screen.z));
    vertex.position = vec4(p, screen.w);
    vertex.toward = vec4(toward, alpha);
    vertex.along = vec4(along, point_parameter(set.parameters, i));
    vertex.across = vec4(across, density);
    vertex.turn = turn;
    target.at[i] = vertex;
}

vec3 row_center(uint row) {
    return 0.5 * (points.at[3u * row] + points.at[3u * row + 1u]);
}

vec3 unit_or(vec3 v, vec3 other) {
    float squared = dot(v, v);
    return squared > 1.0e-20 ? v * inversesqrt(squared) : other;
}

/// Squared share of their length that a row's strands show along a direction of its frame.
float seen_squared(uint row, vec3 d) {
    vec3 squares = set.directions.at[2u * row], products = set.directions.at[2u * row + 1u];
    float hidden = dot(squares, d * d) + 2.0 * dot(products, d * d.yzx);
    return clamp(1.0 - hidden, 1.0e-4, 1.0);
}

/// How many times closer than in the atlas, which faces the card, the strands stand as the eye sees them:
/// they show more or less of their length, on an area `seen_length` times as long and `1 / wider` as wide.
float strand_density(uint row, vec3 to_eye, vec3 x, vec3 n, float seen_length, float wider) {
    vec3 d = vec3(dot(to_eye, x), dot(to_eye, cross(n, x)), dot(to_eye, n));
    float seen = sqrt(seen_squared(row, d) / seen_squared(row, vec3(0.0, 0.0, 1.0)));
    return min(wider * seen / max(seen_length, 1.0e-3), kMostDensity);
}

/// What the piece of a tube around a row spans that is as long as it is wide; w: metres along it. A tube's
/// edges turn with its axis no faster than that: seen nearly along it, those of single rows would turn
/// about each other and sweep many times the area of the tube.
vec4 piece_around(uint row, vec3 center, float radius) {
    vec3 from = center, to = center;
    float walked = 0.0;
    for (uint i = row; point_parameter(set.parameters, 3u * i) > 0.0; --i) {
        if (i != row && distance(from, center) > radius) break;
        vec3 next = row_center(i - 1u);
        walked += distance(next, from);
        from = next;
    }
    for (uint i = row; point_parameter(set.parameters, 3u * i) < 1.0; ++i) {
        if (i != row && distance(to, center) > radius) break;
        vec3 next = row_center(i + 1u);
        walked += distance(next, to);
        to = next;
    }
    return vec4(to - from, walked);
}

void ribbon_row(uint row) {
    uint first = 3u * row;
    float parameter = point_parameter(set.parameters, first);
    vec3 center = row_center(row);
    vec3 along = unit_or(row_center(parameter < 1.0 ? row + 1u : row) -
                             row_center(parameter > 0.0 ? row - 1u : row),
                         vec3(0.0, 1.0, 0.0));
    vec3 side = 0.5 * (points.at[first + 1u] - points.at[first]);
    vec3 front = points.at[first + 2u] - center;
    float a = length(side), b = length(front);
    vec3 x = side / max(a, 1.0e-12), n = front / max(b, 1.0e-12);

    vec3 to_eye = direction_to_eye(center);
    vec4 piece = piece_around(row, center, max(a, b));
    vec3 across_eye = cross(piece.xyz, to_eye);
    vec3 s = unit_or(across_eye, x);
    float sx = dot(s, x), sn = dot(s, n);
    float h = sqrt(a * a * sx * sx + b * b * sn * sn);
    float inverse_h = 1.0 / max(h, 1.0e-12);
    vec3 drawn = (a * a * sx * x + b * b * sn * n) * inverse_h;
    vec3 toward = (a * b * inverse_h) * (sx * n - sn * x);

    // Strands that lead more across the axis than along it wind about it: they look alike from all sides.
    float winding = saturate(3.0 - 5.0 * set.directions.at[2u * row].y);
    vec3 turned = mix(x, drawn / max(a, 1.0e-12), winding);

    vec4 middle = to_screen(center), edge = to_screen(center + drawn);
    float pixels = distance(middle.xy, edge.xy);
    float widen = min(middle.w, edge.w) > 0.0 ? max(1.0, kLeastHalfWidth / max(pixels, 1.0e-6)) : 1.0;
    drawn *= widen;
    float alpha = 1.0 / widen;
    float seen_length = length(across_eye) / max(piece.w, 1.0e-12);
    float density = strand_density(row, to_eye, x, n, seen_length, a * inverse_h);
    float half_u = 0.5 * (set.uvs.at[first + 1u].x - set.uvs.at[first].x);
    vec4 turn = vec4(1.0, a * sx * inverse_h, b * sn * inverse_h, half_u);
    write_vertex(first + 1u, center + drawn, to_eye, toward, along, turned, alpha, density, turn);
    turn.x = -1.0;
    write_vertex(first, center - drawn, to_eye, toward, along, turned, alpha, density, turn);
}

void mesh_vertex(uint i) {
    vec3 p = points.at[i];
    uvec4 frame = set.frames.at[i];
    vec3 along = unit_or(points.at[frame.y] - points.at[frame.x], vec3(0.0, 1.0, 0.0));
    vec3 across = points.at[frame.w] - points.at[frame.z];
    across = unit_or(across - along * dot(across, along), vec3(1.0, 0.0, 0.0));
    vec3 to_eye = direction_to_eye(p);
    vec3 normal = cross(across, along);
    vec3 toward = normal * (dot(normal, to_eye) < 0.0 ? -set.depth_range : set.depth_range);
    write_vertex(i, p, to_eye, toward, along, across, 1.0, 1.0, vec4(0.0));
}

void main() {
    set = cards.set;
    uint i = thread_index();
    if ((set.flags & kCardsRibbons) != 0u) {
        if (3u * i < set.point_count) ribbon_row(i);
    } else if (i < set.point_count) {
        mesh_vertex(i);
    }
}
