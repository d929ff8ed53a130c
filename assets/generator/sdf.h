#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

// Signed distance fields: negative inside, metres. Primitives after Quilez, "Distance functions";
// ellipsoid and round capsule are bounds that are right in sign and near the surface. Everything
// here and in the generator keeps to IEEE arithmetic and square roots, so that the same assets come
// out bit for bit on every machine.
namespace vellus::sculpt {

inline double mix(double a, double b, double t) {
    return a + (b - a) * t;
}

inline double saturate(double x) {
    return std::clamp(x, 0.0, 1.0);
}

inline double smoothstep(double low, double high, double x) {
    const double t = saturate((x - low) / (high - low));
    return t * t * (3.0 - 2.0 * t);
}

inline double sphere(glm::dvec3 p, glm::dvec3 center, double radius) {
    return glm::length(p - center) - radius;
}

inline double ellipsoid(glm::dvec3 p, glm::dvec3 center, glm::dvec3 radii) {
    const glm::dvec3 q = p - center;
    const double k0 = glm::length(q / radii);
    const double k1 = glm::length(q / (radii * radii));
    return k1 == 0.0 ? -std::min({radii.x, radii.y, radii.z}) : k0 * (k0 - 1.0) / k1;
}

/// Capsule from a to b whose radius goes from radius_a to radius_b.
inline double capsule(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, double radius_a, double radius_b) {
    const glm::dvec3 ab = b - a;
    const double h = saturate(glm::dot(p - a, ab) / glm::dot(ab, ab));
    return glm::length(p - a - ab * h) - mix(radius_a, radius_b, h);
}

/// Union with a fillet of width `k`.
inline double join(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * k / 4.0;
}

/// Intersection with a rounded edge of width `k`.
inline double meet(double a, double b, double k) {
    return -join(-a, -b, k);
}

/// `a` without `b`, its edge rounded over `k`.
inline double carve(double a, double b, double k) {
    return meet(a, -b, k);
}

/// Unit gradient by central differences.
template <class Field>
glm::dvec3 normal_of(const Field& field, glm::dvec3 p, double h = 2e-4) {
    const glm::dvec3 x(h, 0.0, 0.0);
    const glm::dvec3 y(0.0, h, 0.0);
    const glm::dvec3 z(0.0, 0.0, h);
    const glm::dvec3 g(field(p + x) - field(p - x), field(p + y) - field(p - y),
                       field(p + z) - field(p - z));
    const double length = glm::length(g);
    return length > 0.0 ? g / length : glm::dvec3(0.0, 1.0, 0.0);
}

/// The point of the surface `field` = 0 near p: a few Newton steps along the gradient.
template <class Field>
glm::dvec3 project(const Field& field, glm::dvec3 p, int steps = 4) {
    for (int i = 0; i < steps; ++i) {
        p -= normal_of(field, p) * field(p);
    }
    return p;
}

/// p moved out along the gradient until it is `clearance` away from the solid `field`.
template <class Field>
glm::dvec3 push_out(const Field& field, glm::dvec3 p, double clearance) {
    for (int round = 0; round < 16; ++round) {
        const double inside = clearance - field(p);
        if (inside <= 0.0) {
            break;
        }
        p += normal_of(field, p, 1e-3) * (inside + 1e-4);
    }
    return p;
}

}  // namespace vellus::sculpt
