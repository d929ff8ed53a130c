// A strand as a chain of rigid links: link i turns by ω_i in a step, so lengths cannot change. One
// implicit step minimises
//   Σ_points ½ (δ - e)ᵀ W (δ - e)                 inertia, drag and contacts: e is where a free point goes
// + Σ_joints ½ (φ + ω_i - ω_{i-1})ᵀ B (same)      bend and twist against the groomed shape
// + Σ_links  ½ (ψ + ω_i)ᵀ K (same) + ½ T l |ω_i⊥|²  hold, and the stiffness that tension gives
// over all ω in one sweep from the tip, which keeps the best value of all that hangs from a point
// as a quadratic of that point's shift a and of the turn w of the link before it, and one sweep
// from the root, which picks each ω and turns the link. Linear in links, no iteration.
//
// Sources: energies of a discrete Cosserat rod as in T. Kugelstadt, E. Schömer, "Position and
// Orientation Based Cosserat Rods" (SCA 2016), links without inertia of their own as in J. Hsu et
// al., "Stable Cosserat Rods" (SIGGRAPH 2025); the sweeps are the articulated-body recursion of
// F. Bertails, "Linear Time Super-Helices" (Eurographics 2009), written as dynamic programming, and
// C. Deul et al., "Direct Position-Based Solver for Stiff Rods" (CGF 2018) solves the same chain
// with multipliers for the lengths instead.
#if !defined(VELLUS_ROD_LINK_GLSL) || defined(__cplusplus)
#define VELLUS_ROD_LINK_GLSL
#ifndef __cplusplus
#include "hair/dynamics/rod_math.glsl"
#endif

/// ½ aᵀPa + aᵀSw + ½ wᵀDw + pᵀa + qᵀw: the least cost of what hangs from a point.
struct RodValue {
    RodSymmetric P;
    RodMatrix S;
    RodSymmetric D;
    rvec3 p;
    rvec3 q;
};

/// What one link adds.
struct RodLink {
    rvec3 offset;           // from its root end to its tip end, r
    RodSymmetric weight;    // W of the point at its tip end
    rvec3 target;           // W e
    RodSymmetric joint;     // B, damping included
    rvec3 joint_moment;     // gradient of the joint's energy in ω_i
    RodSymmetric own;       // K and T l (I - d dᵀ)
    rvec3 own_moment;       // gradient of the hold energy
};

/// ω = turn w - shift a - constant.
struct RodGain {
    RodMatrix shift;
    RodMatrix turn;
    rvec3 constant;
};

VELLUS_FN RodValue rod_no_value() {
    RodValue v;
    rvec3 zero = rvec3(real(0.0f), real(0.0f), real(0.0f));
    v.P = rod_symmetric(real(0.0f), real(0.0f), zero);
    v.D = v.P;
    v.S.x = zero;
    v.S.y = zero;
    v.S.z = zero;
    v.p = zero;
    v.q = zero;
    return v;
}

/// Takes in one link at the root end; returns how its turn follows from a and w.
VELLUS_FN RodGain rod_backward(RodLink link, VELLUS_INOUT(RodValue) v) {
    rvec3 r = link.offset;
    RodSymmetric P = rod_add(v.P, link.weight);
    rvec3 p = v.p - link.target;

    // The tip end moves by a + ω × r. Columns of [ω ↦ ω × r]:
    real zero = real(0.0f);
    rvec3 gx = rvec3(zero, -r.z, r.y);
    rvec3 gy = rvec3(r.z, zero, -r.x);
    rvec3 gz = rvec3(-r.y, r.x, zero);
    RodMatrix X;  // couples a and ω
    X.x = rod_mul(P, gx) + v.S.x;
    X.y = rod_mul(P, gy) + v.S.y;
    X.z = rod_mul(P, gz) + v.S.z;
    RodSymmetric H;  // of ω, without the joint
    H.xx = rod_dot(gx, X.x) + rod_dot(v.S.x, gx) + v.D.xx + link.own.xx;
    H.yy = rod_dot(gy, X.y) + rod_dot(v.S.y, gy) + v.D.yy + link.own.yy;
    H.zz = rod_dot(gz, X.z) + rod_dot(v.S.z, gz) + v.D.zz + link.own.zz;
    H.xy = rod_dot(gx, X.y) + rod_dot(v.S.x, gy) + v.D.xy + link.own.xy;
    H.xz = rod_dot(gx, X.z) + rod_dot(v.S.x, gz) + v.D.xz + link.own.xz;
    H.yz = rod_dot(gy, X.z) + rod_dot(v.S.y, gz) + v.D.yz + link.own.yz;
    rvec3 f = rod_cross(r, p) + v.q + link.own_moment + link.joint_moment;

    RodSymmetric inverse = rod_inverse(rod_add(H, link.joint));
    RodGain gain;
    // H⁻¹ Xᵀ: its columns come from the rows of X.
    gain.shift.x = rod_mul(inverse, rvec3(X.x.x, X.y.x, X.z.x));
    gain.shift.y = rod_mul(inverse, rvec3(X.x.y, X.y.y, X.z.y));
    gain.shift.z = rod_mul(inverse, rvec3(X.x.z, X.y.z, X.z.z));
    gain.turn.x = rod_mul(inverse, rvec3(link.joint.xx, link.joint.xy, link.joint.xz));
    gain.turn.y = rod_mul(inverse, rvec3(link.joint.xy, link.joint.yy, link.joint.yz));
    gain.turn.z = rod_mul(inverse, rvec3(link.joint.xz, link.joint.yz, link.joint.zz));
    gain.constant = rod_mul(inverse, f);

    rvec3 x0 = rod_mul(X, gain.shift.x);
    rvec3 x1 = rod_mul(X, gain.shift.y);
    rvec3 x2 = rod_mul(X, gain.shift.z);
    v.P.xx = P.xx - x0.x;
    v.P.yy = P.yy - x1.y;
    v.P.zz = P.zz - x2.z;
    v.P.xy = P.xy - x1.x;
    v.P.xz = P.xz - x2.x;
    v.P.yz = P.yz - x2.y;
    v.S.x = rod_mul(X, gain.turn.x);
    v.S.y = rod_mul(X, gain.turn.y);
    v.S.z = rod_mul(X, gain.turn.z);
    // B - B H⁻¹ B as (H⁻¹ B)ᵀ (H - B): no difference of large numbers where joints are stiff.
    rvec3 hx = rvec3(H.xx, H.xy, H.xz);
    rvec3 hy = rvec3(H.xy, H.yy, H.yz);
    rvec3 hz = rvec3(H.xz, H.yz, H.zz);
    v.D.xx = rod_dot(gain.turn.x, hx);
    v.D.yy = rod_dot(gain.turn.y, hy);
    v.D.zz = rod_dot(gain.turn.z, hz);
    v.D.xy = rod_dot(gain.turn.x, hy);
    v.D.xz = rod_dot(gain.turn.x, hz);
    v.D.yz = rod_dot(gain.turn.y, hz);
    v.p = p - rod_mul(X, gain.constant);
    v.q = rod_mul_transposed(gain.turn, f) - link.joint_moment;
    return gain;
}

#endif
