#pragma once

#include <cmath>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

// What the mathematics headers of the rod solver (shaders/hair/dynamics) are written over: a number
// type, its mask, and small vectors of it.
namespace vellus::hair {

/// Guides that the processor works on at once. Guides are padded to a multiple of it.
constexpr uint32_t kRodLanes = 4;

namespace lanes {

/// Four floats side by side; every lane computes what one float alone would.
struct Lanes {
    using Floats = float __attribute__((vector_size(16)));
    using Bits = int32_t __attribute__((vector_size(16)));
    Floats v{};

    Lanes() = default;
    // Implicit as float's own conversions are, so that one text serves both.
    Lanes(float x) : v{x, x, x, x} {}  // NOLINT(google-explicit-constructor)
    Lanes(Floats x) : v(x) {}          // NOLINT(google-explicit-constructor)

    friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
    friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
    friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
    friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
    friend Lanes operator-(Lanes a) { return -a.v; }
    friend Bits operator<(Lanes a, Lanes b) { return a.v < b.v; }
    friend Bits operator>(Lanes a, Lanes b) { return a.v > b.v; }
};

inline Lanes choose(Lanes::Bits condition, Lanes yes, Lanes no) {
    return condition ? yes.v : no.v;
}
inline bool any_lane(Lanes::Bits b) {
#ifdef __SSE2__
    return _mm_movemask_ps(reinterpret_cast<__m128>(b)) != 0;
#else
    return (b[0] | b[1] | b[2] | b[3]) != 0;
#endif
}
inline Lanes min(Lanes a, Lanes b) {
    return a.v < b.v ? a.v : b.v;
}
inline Lanes max(Lanes a, Lanes b) {
    return a.v > b.v ? a.v : b.v;
}
inline Lanes abs(Lanes a) {
    return max(a, -a);
}
inline Lanes sqrt(Lanes a) {
#ifdef __SSE2__
    return _mm_sqrt_ps(a.v);
#else
    for (int i = 0; i < 4; ++i) a.v[i] = std::sqrt(a.v[i]);
    return a;
#endif
}
/// Of numbers below 2^31.
inline Lanes floor(Lanes a) {
    const Lanes::Floats t =
        __builtin_convertvector(__builtin_convertvector(a.v, Lanes::Bits), Lanes::Floats);
    return t > a.v ? t - 1.0f : t;
}

}  // namespace lanes

template <class T>
struct RodVec3 {
    T x{};
    T y{};
    T z{};

    RodVec3() = default;
    RodVec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    friend RodVec3 operator+(RodVec3 a, RodVec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend RodVec3 operator-(RodVec3 a, RodVec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend RodVec3 operator*(RodVec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
};

template <class T>
struct RodVec4 {
    T x{};
    T y{};
    T z{};
    T w{};

    RodVec4() = default;
    RodVec4(T x_, T y_, T z_, T w_) : x(x_), y(y_), z(z_), w(w_) {}
};

}  // namespace vellus::hair
