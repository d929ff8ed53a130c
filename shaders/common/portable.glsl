// Makes one mathematics header compile as GLSL 460 and as C++ (GLM, through shaders/common/portable.h).
//
// GLSL: the stage file enables GL_GOOGLE_include_directive and includes headers by their path below
// shaders/. C++: modules/<m>/.../NAME.h includes shaders/common/portable.h, opens
// `namespace vellus::<m>::glsl { using namespace vellus::glsl; ... }` and includes NAME.glsl there.
// Headers write VELLUS_FN before functions, VELLUS_OUT(T) / VELLUS_INOUT(T) for reference parameters,
// VELLUS_IN(T) for large ones that are only read,
// float literals with f, no swizzles, no array or struct constructors, no fused declarations of both.
#ifndef VELLUS_PORTABLE_GLSL
#define VELLUS_PORTABLE_GLSL

#ifdef __cplusplus
#define VELLUS_FN inline
#define VELLUS_IN(type) const type&
#define VELLUS_OUT(type) type&
#define VELLUS_INOUT(type) type&
#else
#define VELLUS_FN
#define VELLUS_IN(type) type
#define VELLUS_OUT(type) out type
#define VELLUS_INOUT(type) inout type
#endif

const float kPi = 3.14159265f;
const float kInvPi = 0.318309886f;
const float kLog2E = 1.44269504f;

VELLUS_FN float saturate(float x) { return clamp(x, 0.0f, 1.0f); }

VELLUS_FN float square(float x) { return x * x; }

/// Square root that takes a negative rounding error for zero.
VELLUS_FN float safe_sqrt(float x) { return sqrt(max(x, 0.0f)); }

/// True for ordinary numbers. Bit test: GLSL lets isnan and isinf be optimised away.
VELLUS_FN bool is_finite(float x) { return (floatBitsToUint(x) & 0x7F800000u) != 0x7F800000u; }

VELLUS_FN bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// Bijective 32-bit mix, "lowbias32" (C. Wellons, hash-prospector).
VELLUS_FN uint hash_uint(uint x) {
    x ^= x >> 16u;
    x *= 0x7FEB352Du;
    x ^= x >> 15u;
    x *= 0x846CA68Bu;
    x ^= x >> 16u;
    return x;
}

/// The top 24 bits as a float in [0, 1); never rounds up to 1.
VELLUS_FN float unit_float(uint x) { return float(x >> 8u) * (1.0f / 16777216.0f); }

#endif
