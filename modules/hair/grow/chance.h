#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

// Chance and waves from integers, products and square roots alone: the same bits on every machine.
namespace vellus::hair::grow {

/// Bits that depend on the three alone (PCG output function, twice).
inline uint32_t hash(uint32_t seed, uint32_t key, uint32_t salt) {
    uint32_t x = (key + seed * 0x9E3779B9U) * 747796405U + salt * 2891336453U + 12345U;
    for (int round = 0; round < 2; ++round) {
        x = ((x >> ((x >> 28U) + 4U)) ^ x) * 277803737U;
        x = ((x >> 22U) ^ x) * 747796405U + 2891336453U + seed;
    }
    return x ^ (x >> 16U);
}

/// In [0, 1).
inline double random(uint32_t seed, uint32_t key, uint32_t salt) {
    return hash(seed, key, salt) / 4294967296.0;
}

/// In [-1, 1).
inline double spread(uint32_t seed, uint32_t key, uint32_t salt) {
    return 2.0 * random(seed, key, salt) - 1.0;
}

/// sin(2 pi turns) within 1e-3.
inline double wave(double turns) {
    const double t = turns - std::floor(turns);
    const double half = t < 0.5 ? t : t - 0.5;
    const double arch = 16.0 * half * (0.5 - half);
    const double bump = arch * (0.775 + 0.225 * arch);
    return t < 0.5 ? bump : -bump;
}

/// Smooth noise in about [-1, 1] over space: three crossed waves.
inline double noise(glm::dvec3 p, double period, uint32_t seed, uint32_t salt) {
    const glm::dvec3 q = p / period;
    return (wave(q.x + 0.37 * q.y + random(seed, salt, 1)) +
            wave(q.y + 0.31 * q.z + random(seed, salt, 2)) +
            wave(q.z + 0.41 * q.x + random(seed, salt, 3))) /
           3.0;
}

inline double saturate(double x) {
    return std::clamp(x, 0.0, 1.0);
}

inline double mix(double a, double b, double t) {
    return a + (b - a) * t;
}

/// 0 below `low`, 1 above `high` (which may be the smaller one), smooth between.
inline double smoothstep(double low, double high, double x) {
    const double t = saturate((x - low) / (high - low));
    return t * t * (3.0 - 2.0 * t);
}

/// `v` at unit length; `otherwise` where it has none.
inline glm::dvec3 unit(glm::dvec3 v, glm::dvec3 otherwise) {
    const double length = glm::length(v);
    return length > 1e-12 ? v / length : otherwise;
}

/// The part of `v` across the unit vector `normal`.
inline glm::dvec3 across(glm::dvec3 v, glm::dvec3 normal) {
    return v - normal * glm::dot(v, normal);
}

/// Some unit vector across the unit vector `normal`.
inline glm::dvec3 any_across(glm::dvec3 normal) {
    const glm::dvec3 axis = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::normalize(across(axis, normal));
}

}  // namespace vellus::hair::grow
