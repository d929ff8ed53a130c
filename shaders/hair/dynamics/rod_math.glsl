// Small linear algebra of the rod solver, written over `real`: float on the device; in C++ float,
// double and four floats side by side (modules/hair/dynamics/rod.h), which is why nothing branches.
#if !defined(VELLUS_ROD_MATH_GLSL) || defined(__cplusplus)
#define VELLUS_ROD_MATH_GLSL
#ifndef __cplusplus
#include "common/portable.glsl"
#define real float
#define rvec3 vec3
#define rvec4 vec4
#define rmask bool
float choose(bool condition, float yes, float no) { return condition ? yes : no; }
bool any_lane(bool condition) { return condition; }
#endif

VELLUS_FN real rod_dot(rvec3 a, rvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

VELLUS_FN rvec3 rod_cross(rvec3 a, rvec3 b) {
    return rvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

VELLUS_FN real rod_length(rvec3 a) { return sqrt(rod_dot(a, a)); }

VELLUS_FN rvec3 rod_choose(rmask condition, rvec3 yes, rvec3 no) {
    return rvec3(choose(condition, yes.x, no.x), choose(condition, yes.y, no.y),
                 choose(condition, yes.z, no.z));
}

/// a scaled down to length `limit` where it is longer.
VELLUS_FN rvec3 rod_limit(rvec3 a, real limit) {
    return a * min(real(1.0f), limit / max(rod_length(a), real(1.0e-12f)));
}

// Unit quaternions, x y z w.

VELLUS_FN rvec4 rod_multiply(rvec4 a, rvec4 b) {
    return rvec4(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                 a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                 a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
                 a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
}

VELLUS_FN rvec4 rod_conjugate(rvec4 q) { return rvec4(-q.x, -q.y, -q.z, q.w); }

VELLUS_FN rvec4 rod_normalize(rvec4 q) {
    real scale = real(1.0f) /
                 sqrt(max(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, real(1.0e-30f)));
    return rvec4(q.x * scale, q.y * scale, q.z * scale, q.w * scale);
}

VELLUS_FN rvec3 rod_rotate(rvec4 q, rvec3 v) {
    rvec3 u = rvec3(q.x, q.y, q.z);
    rvec3 t = rod_cross(u, v) * real(2.0f);
    return v + t * q.w + rod_cross(u, t);
}

/// Axis times angle in [0, π]: a polynomial in 1 - |w|, off by at most 1.4e-5 relative.
VELLUS_FN rvec3 rod_rotation_vector(rvec4 q) {
    real u = real(1.0f) - min(abs(q.w), real(1.0f));
    real half_angle_over_sine =
        real(1.0f) +
        u * (real(0.33332617f) +
             u * (real(0.13384554f) +
                  u * (real(0.05137123f) +
                       u * (real(0.04831526f) + u * (real(-0.02704766f) + u * real(0.03097207f))))));
    real scale = choose(q.w < real(0.0f), real(-2.0f), real(2.0f)) * half_angle_over_sine;
    return rvec3(q.x * scale, q.y * scale, q.z * scale);
}

/// The rotation about w by 2 atan(|w| / 2) (Cayley): |w| for small steps, never past π.
VELLUS_FN rvec4 rod_cayley(rvec3 w) {
    return rod_normalize(rvec4(w.x * real(0.5f), w.y * real(0.5f), w.z * real(0.5f), real(1.0f)));
}

/// The least rotation that takes unit a to unit b; some rotation where they are opposite.
VELLUS_FN rvec4 rod_between(rvec3 a, rvec3 b) {
    rvec3 c = rod_cross(a, b);
    return rod_normalize(rvec4(c.x, c.y, c.z, max(real(1.0f) + rod_dot(a, b), real(1.0e-4f))));
}

// Symmetric and general 3x3 matrices.

struct RodSymmetric {
    real xx;
    real yy;
    real zz;
    real xy;
    real xz;
    real yz;
};

/// By columns.
struct RodMatrix {
    rvec3 x;
    rvec3 y;
    rvec3 z;
};

VELLUS_FN rvec3 rod_mul(RodSymmetric m, rvec3 v) {
    return rvec3(m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
                 m.xz * v.x + m.yz * v.y + m.zz * v.z);
}

VELLUS_FN rvec3 rod_mul(RodMatrix m, rvec3 v) { return m.x * v.x + m.y * v.y + m.z * v.z; }

VELLUS_FN rvec3 rod_mul_transposed(RodMatrix m, rvec3 v) {
    return rvec3(rod_dot(m.x, v), rod_dot(m.y, v), rod_dot(m.z, v));
}

/// diagonal I + along a aᵀ.
VELLUS_FN RodSymmetric rod_symmetric(real diagonal, real along, rvec3 a) {
    RodSymmetric m;
    m.xx = diagonal + along * a.x * a.x;
    m.yy = diagonal + along * a.y * a.y;
    m.zz = diagonal + along * a.z * a.z;
    m.xy = along * a.x * a.y;
    m.xz = along * a.x * a.z;
    m.yz = along * a.y * a.z;
    return m;
}

VELLUS_FN RodSymmetric rod_add(RodSymmetric a, RodSymmetric b) {
    RodSymmetric m;
    m.xx = a.xx + b.xx;
    m.yy = a.yy + b.yy;
    m.zz = a.zz + b.zz;
    m.xy = a.xy + b.xy;
    m.xz = a.xz + b.xz;
    m.yz = a.yz + b.yz;
    return m;
}

/// Of a positive definite matrix.
VELLUS_FN RodSymmetric rod_inverse(RodSymmetric m) {
    RodSymmetric r;
    r.xx = m.yy * m.zz - m.yz * m.yz;
    r.xy = m.xz * m.yz - m.xy * m.zz;
    r.xz = m.xy * m.yz - m.xz * m.yy;
    real scale = real(1.0f) / max(m.xx * r.xx + m.xy * r.xy + m.xz * r.xz, real(1.0e-36f));
    r.yy = (m.xx * m.zz - m.xz * m.xz) * scale;
    r.yz = (m.xy * m.xz - m.xx * m.yz) * scale;
    r.zz = (m.xx * m.yy - m.xy * m.xy) * scale;
    r.xx = r.xx * scale;
    r.xy = r.xy * scale;
    r.xz = r.xz * scale;
    return r;
}

#endif
