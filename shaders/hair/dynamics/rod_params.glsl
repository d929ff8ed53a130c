// What one frame of motion is told: mirrored byte for byte in C++ (scalar layout).
#ifndef VELLUS_ROD_PARAMS_GLSL
#define VELLUS_ROD_PARAMS_GLSL

/// Everything per unit of the strand's mass per length, so that weight cancels.
struct RodParams {
    vec3 gravity;       // m/s²
    float step;         // s, of one substep
    vec3 wind;          // m/s
    float gust;         // gusts over mean wind, 0 to 1
    vec3 gust_phase;    // turns, at the first substep
    float drag;         // 1/s, towards the speed of the air
    vec3 gust_rate;     // turns a substep
    float stiffness;    // bending, m⁴/s²: bend length cubed times 9.81
    float twist;        // stiffness against twist over bending
    float damping;      // s: rate of bend that resists like the bend itself
    float hold;         // per link, over the moment of the whole strand's weight at it
    float friction;     // 1/s, along a collider
    float inertia;      // share of the root's travel that the strand feels as a jolt
    float memory;       // 1, or 0 to start as fast as the root (first seen, after a teleport)
    float scale;        // metres per metre of the guides' rest
    uint substeps;
    uint capsules;
};

/// A capsule in metres from the anchor, at the start and the end of the frame; ends may coincide.
struct RodCapsule {
    vec3 a0;
    float radius;
    vec3 b0;
    float padding0;
    vec3 a1;
    float padding1;
    vec3 b1;
    float padding2;
};

/// A guide's root in the world. Quaternions x y z w from the groom as loaded: at the start of the
/// frame, and by how much each substep turns it. Positions from the anchor, at start and end.
struct RodRoot {
    vec4 turn;
    vec4 spin;
    vec3 place0;
    vec3 place1;
};

const int kRodMaxLinks = 31;

#endif
