#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/portable.glsl"
#include "common/thread.glsl"
#include "hair/dynamics/follow.glsl"

// Bends strands that their roots have carried, this frame and the last, as their guides bend. One thread
// a strand.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    Points points;
    Points previous_points;
    Uints strand_begin;
    Uints parameters;
    Follow follow;
    Uvec2s turns;  // four signed 16 bit each, guide by guide
    Uvec2s previous_turns;
    uint strand_count;
    uint links;
};

#include "hair/dynamics/guide_turn.glsl"
#include "hair/dynamics/transfer.glsl"

void bend(Points points_of, uint first, uint last, StrandGuides guides) {
    vec3 carried = points_of.at[first];
    vec3 point = carried;
    float u = 0.0;
    for (uint i = first + 1u; i < last; ++i) {
        float next_u = point_parameter(parameters, i);
        vec4 turn = strand_turn(guides.guides, guides.weights, guides.reach, 0.5 * (u + next_u), links);
        vec3 next = points_of.at[i];
        point += turn_vector(turn, next - carried);
        points_of.at[i] = point;
        carried = next;
        u = next_u;
    }
}

void main() {
    uint strand = thread_index();
    if (strand >= strand_count) return;
    uint first = strand_begin.at[strand], last = strand_begin.at[strand + 1u];
    StrandGuides guides = follow.at[strand];
    bend(points, first, last, guides);
    before = true;
    bend(previous_points, first, last, guides);
}
