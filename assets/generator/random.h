#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

// Chance and waves for the generator, from integers and products alone.
namespace vellus::sculpt {

/// Numbers in [0, 1) that depend on `key` and `salt` alone (PCG output function).
inline double random(uint32_t key, uint32_t salt) {
    uint32_t x = key * 747796405U + salt * 2891336453U + 12345U;
    x = ((x >> ((x >> 28U) + 4U)) ^ x) * 277803737U;
    x = (x >> 22U) ^ x;
    x = x * 747796405U + 2891336453U;
    x = ((x >> ((x >> 28U) + 4U)) ^ x) * 277803737U;
    return ((x >> 22U) ^ x) / 4294967296.0;
}

inline double spread(uint32_t key, uint32_t salt) {
    return 2.0 * random(key, salt) - 1.0;
}

/// A wave of period 1 and amplitude 1, smooth like a sine and made of products only.
inline double wave(double turns) {
    const double t = turns - std::floor(turns);
    const double half = t < 0.5 ? t : t - 0.5;
    const double arch = 16.0 * half * (0.5 - half);
    const double bump = arch * (0.775 + 0.225 * arch);
    return t < 0.5 ? bump : -bump;
}

/// Smooth noise in about [-1, 1] over space: three crossed waves.
inline double noise(glm::dvec3 p, double period, uint32_t salt) {
    const glm::dvec3 q = p / period;
    return (wave(q.x + 0.37 * q.y + random(salt, 1)) + wave(q.y + 0.31 * q.z + random(salt, 2)) +
            wave(q.z + 0.41 * q.x + random(salt, 3))) /
           3.0;
}

}  // namespace vellus::sculpt
