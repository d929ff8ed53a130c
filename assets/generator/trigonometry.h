#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

// Sines and turns from products and square roots alone: the same bits on every machine.
namespace vellus::sculpt {

/// Sine of `turns` full circles: Taylor's series to the 19th power over a quarter turn, good to
/// 1e-15.
inline double sine(double turns) {
    double t = turns - std::floor(turns + 0.5);
    t = t > 0.25 ? 0.5 - t : t < -0.25 ? -0.5 - t : t;
    const double x = 6.283185307179586 * t;
    double term = x;
    double sum = x;
    for (int n = 3; n <= 19; n += 2) {
        term *= -x * x / (n * (n - 1));
        sum += term;
    }
    return sum;
}

inline double cosine(double turns) {
    return sine(turns + 0.25);
}

/// Rotation about a unit axis by degrees.
inline glm::dquat turn_about(glm::dvec3 axis, double degrees) {
    const double half = degrees / 720.0;
    return {cosine(half), axis * sine(half)};
}

/// Rotations about +X (nods), +Y (turns left) and +Z (leans right), in degrees; X acts first.
inline glm::dquat tilt(double nod, double yaw, double lean) {
    return turn_about({0.0, 1.0, 0.0}, yaw) * turn_about({0.0, 0.0, 1.0}, lean) *
           turn_about({1.0, 0.0, 0.0}, nod);
}

/// The shortest rotation from one unit vector to another, not its opposite.
inline glm::dquat rotation_between(glm::dvec3 from, glm::dvec3 to) {
    return glm::normalize(glm::dquat(1.0 + glm::dot(from, to), glm::cross(from, to)));
}

}  // namespace vellus::sculpt
