#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/portable.glsl"
#include "common/thread.glsl"
#include "hair/dynamics/follow.glsl"

// Bends cards that their roots have carried, this frame and the last, as their guides bend: the middles of
// a card's rows move like a strand's points, and each row turns about its own. One thread a card.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    Points points;
    Points previous_points;
    Uints card_begin;  // rows of each card
    Uints row_begin;   // of row_points
    Uints row_points;
    Uints parameters;
    Follow follow;
    Uvec2s turns;
    Uvec2s previous_turns;
    uint card_count;
    uint links;
    uint edge;  // a row's middle is the mean of up to so many first points
};

#include "hair/dynamics/guide_turn.glsl"
#include "hair/dynamics/transfer.glsl"

vec3 row_middle(Points points_of, uint first, uint end) {
    end = min(end, first + edge);
    vec3 sum = vec3(0.0);
    for (uint i = first; i < end; ++i) sum += points_of.at[row_points.at[i]];
    return sum / float(end - first);
}

void bend(Points points_of, uint first_row, uint end_row, StrandGuides guides) {
    vec3 carried = vec3(0.0), middle = vec3(0.0);
    float u = 0.0;
    for (uint row = first_row; row < end_row; ++row) {
        uint first = row_begin.at[row], end = row_begin.at[row + 1u];
        float next_u = point_parameter(parameters, row_points.at[first]);
        vec3 next = row_middle(points_of, first, end);
        if (row == first_row) {
            middle = next;
        } else {
            vec4 along = strand_turn(guides.guides, guides.weights, guides.reach, 0.5 * (u + next_u), links);
            middle += turn_vector(along, next - carried);
        }
        vec4 turn = strand_turn(guides.guides, guides.weights, guides.reach, next_u, links);
        for (uint i = first; i < end; ++i) {
            uint point = row_points.at[i];
            points_of.at[point] = middle + turn_vector(turn, points_of.at[point] - next);
        }
        carried = next;
        u = next_u;
    }
}

void main() {
    uint card = thread_index();
    if (card >= card_count) return;
    uint first = card_begin.at[card], end = card_begin.at[card + 1u];
    StrandGuides guides = follow.at[card];
    bend(points, first, end, guides);
    before = true;
    bend(previous_points, first, end, guides);
}
