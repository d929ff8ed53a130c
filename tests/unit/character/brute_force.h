#pragma once

#include <cmath>
#include <vector>

#include "engine/asset/scene_asset.h"

// Animation evaluated another way than modules/character/sampling.cpp: linear scan for the key,
// rotations by axis and angle, cubic splines by de Casteljau on the Bezier form.
namespace vellus::character::test {

inline std::vector<double> key_value(const asset::AnimationChannel& c, size_t key, int part) {
    const bool cubic = c.interpolation == asset::Interpolation::kCubicSpline;
    const size_t first = (cubic ? 3 * key + part : key) * c.width;
    return {c.values.begin() + first, c.values.begin() + first + c.width};
}

inline std::vector<double> mix(const std::vector<double>& a, const std::vector<double>& b,
                               double u) {
    std::vector<double> result(a.size());
    for (size_t i = 0; i < a.size(); ++i) result[i] = (1.0 - u) * a[i] + u * b[i];
    return result;
}

inline glm::dquat to_quat(const std::vector<double>& v) {
    return glm::dquat(v[3], v[0], v[1], v[2]) /
           std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
}

/// from · exp(u · log(from⁻¹ to)), the rotation by a share of the angle between the two.
inline std::vector<double> turn(const std::vector<double>& a, const std::vector<double>& b,
                                double u) {
    const glm::dquat from = to_quat(a);
    glm::dquat between = glm::conjugate(from) * to_quat(b);
    if (between.w < 0.0) between = -between;
    const glm::dvec3 v(between.x, between.y, between.z);
    const double sine = glm::length(v);
    glm::dquat part(1, 0, 0, 0);
    if (sine > 1e-12) part = glm::angleAxis(2.0 * u * std::atan2(sine, between.w), v / sine);
    const glm::dquat q = from * part;
    return {q.x, q.y, q.z, q.w};
}

inline std::vector<double> bezier(const asset::AnimationChannel& c, size_t key, double u,
                                  double span) {
    auto p0 = key_value(c, key, 1);
    auto p3 = key_value(c, key + 1, 1);
    auto p1 = key_value(c, key, 2);
    auto p2 = key_value(c, key + 1, 0);
    for (size_t i = 0; i < p0.size(); ++i) {
        p1[i] = p0[i] + span / 3.0 * p1[i];
        p2[i] = p3[i] - span / 3.0 * p2[i];
    }
    const auto a = mix(p0, p1, u);
    const auto b = mix(p1, p2, u);
    const auto d = mix(p2, p3, u);
    return mix(mix(a, b, u), mix(b, d, u), u);
}

inline std::vector<double> brute_force(const asset::AnimationChannel& c, double time) {
    const bool rotation = c.path == asset::AnimationPath::kRotation;
    std::vector<double> value = key_value(c, 0, 1);
    for (size_t k = 0; k < c.times.size(); ++k) {
        if (time < c.times[k]) break;
        value = key_value(c, k, 1);
        if (k + 1 == c.times.size() || time >= c.times[k + 1]) continue;
        const double span = double(c.times[k + 1]) - double(c.times[k]);
        const double u = (time - c.times[k]) / span;
        if (c.interpolation == asset::Interpolation::kCubicSpline) {
            value = bezier(c, k, u, span);
        } else if (c.interpolation == asset::Interpolation::kLinear) {
            value = rotation ? turn(value, key_value(c, k + 1, 1), u)
                             : mix(value, key_value(c, k + 1, 1), u);
        }
    }
    if (!rotation) return value;
    const glm::dquat q = to_quat(value);
    return {q.x, q.y, q.z, q.w};
}

}  // namespace vellus::character::test
