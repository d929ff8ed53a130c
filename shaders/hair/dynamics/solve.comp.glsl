#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "common/portable.glsl"
#include "common/thread.glsl"
#include "hair/dynamics/rod_math.glsl"
#include "hair/dynamics/rod_link.glsl"
#include "hair/dynamics/rod_contact.glsl"
#include "hair/dynamics/rod_params.glsl"

// A frame of motion, one thread a guide; then how its links are turned from where the root carries them.
// Columns as in modules/hair/dynamics/guides.h: component, link, guide.
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) readonly buffer Column { float at[]; };
layout(buffer_reference, scalar) buffer StateColumn { float at[]; };
layout(buffer_reference, scalar) readonly buffer Params { RodParams at; };
layout(buffer_reference, scalar) readonly buffer Roots { RodRoot at[]; };
layout(buffer_reference, scalar) readonly buffer Capsules { RodCapsule at[]; };
layout(buffer_reference, scalar) readonly buffer Quaternions { vec4 at[]; };
layout(buffer_reference, scalar) writeonly buffer Turns { uvec2 at[]; };
layout(push_constant, scalar) uniform Push {
    Params params;
    Roots roots;
    Capsules capsules;
    Quaternions shown;  // of each root, where the frame is shown
    Column rest;
    Column preload;
    StateColumn rotation;
    StateColumn velocity;
    StateColumn tension;
    Turns turns;
    uint count;
    uint stride;
    uint links;
};

uint guide;
int rod_links;
RodParams rod_params;
rvec4 rod_turn, rod_spin;
rvec3 rod_place0, rod_place1;
uint rod_near;
rvec3 rod_olds[kRodMaxLinks];
rvec3 rod_offsets[kRodMaxLinks];
rvec3 rod_spins[kRodMaxLinks];
rvec3 rod_forces[kRodMaxLinks];
RodGain rod_gains[kRodMaxLinks];

uint place_of(int component, int link) { return uint(component * rod_links + link) * stride + guide; }

rvec3 rod_spread(vec3 v) { return v; }
rvec3 rod_rest(int i) {
    return vec3(rest.at[place_of(0, i)], rest.at[place_of(1, i)], rest.at[place_of(2, i)]);
}
rvec3 rod_preload(int i) {
    return vec3(preload.at[place_of(0, i)], preload.at[place_of(1, i)], preload.at[place_of(2, i)]);
}
rvec3 rod_velocity(int i) {
    return vec3(velocity.at[place_of(0, i)], velocity.at[place_of(1, i)], velocity.at[place_of(2, i)]);
}
rvec4 rod_rotation(int i) {
    return vec4(rotation.at[place_of(0, i)], rotation.at[place_of(1, i)], rotation.at[place_of(2, i)],
                rotation.at[place_of(3, i)]);
}
float rod_tension(int i) { return tension.at[place_of(0, i)]; }
void rod_set_velocity(int i, vec3 v) {
    velocity.at[place_of(0, i)] = v.x;
    velocity.at[place_of(1, i)] = v.y;
    velocity.at[place_of(2, i)] = v.z;
}
void rod_set_rotation(int i, vec4 q) {
    rotation.at[place_of(0, i)] = q.x;
    rotation.at[place_of(1, i)] = q.y;
    rotation.at[place_of(2, i)] = q.z;
    rotation.at[place_of(3, i)] = q.w;
}
void rod_set_tension(int i, float t) { tension.at[place_of(0, i)] = t; }
RodCapsuleStep rod_capsule(int c, float begin, float end) {
    RodCapsule capsule = capsules.at[c];
    RodCapsuleStep now;
    now.a = capsule.a0 + (capsule.a1 - capsule.a0) * end;
    now.b = capsule.b0 + (capsule.b1 - capsule.b0) * end;
    now.a_travel = (capsule.a1 - capsule.a0) * (end - begin);
    now.b_travel = (capsule.b1 - capsule.b0) * (end - begin);
    now.radius = capsule.radius;
    return now;
}

#include "hair/dynamics/rod_step.glsl"

void main() {
    guide = thread_index();
    if (guide >= count) return;
    rod_links = int(links);
    rod_params = params.at;
    RodRoot root = roots.at[guide];
    rod_turn = root.turn;
    rod_spin = root.spin;
    rod_place0 = root.place0;
    rod_place1 = root.place1;
    if (rod_params.substeps > 0u) rod_frame();
    vec4 carried = shown.at[guide];
    for (int i = 0; i < rod_links; ++i) {
        vec4 turn = rod_multiply(rod_multiply(carried, rod_rotation(i)), rod_conjugate(carried));
        turns.at[guide * links + uint(i)] = uvec2(packSnorm2x16(turn.xy), packSnorm2x16(turn.zw));
    }
}
