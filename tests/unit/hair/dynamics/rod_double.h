#pragma once

#include <array>
#include <vector>

#include "modules/hair/dynamics/guides.h"
#include "modules/hair/dynamics/rod.h"

/// The shader's solver in double, one guide at a time: the reference for float, lanes and device.
namespace vellus::hair::rod_double {
using namespace vellus::hair::glsl;  // NOLINT(google-build-using-namespace)
using real = double;
using rmask = bool;
using rvec3 = RodVec3<double>;
using rvec4 = RodVec4<double>;
inline double min(double a, double b) {
    return a < b ? a : b;
}
inline double max(double a, double b) {
    return a > b ? a : b;
}
inline double abs(double a) {
    return a < 0.0 ? -a : a;
}
inline double sqrt(double a) {
    return std::sqrt(a);
}
inline double floor(double a) {
    return std::floor(a);
}
inline double choose(bool condition, double yes, double no) {
    return condition ? yes : no;
}
inline bool any_lane(bool condition) {
    return condition;
}
// Each builds on the one before.
// clang-format off
#include "hair/dynamics/rod_math.glsl"
#include "hair/dynamics/rod_link.glsl"
#include "hair/dynamics/rod_contact.glsl"
// clang-format on
inline rvec3 rod_spread(vec3 v) {
    return {v.x, v.y, v.z};
}

struct Guide {
    explicit Guide(const GuideSet& guides, uint32_t index)
        : rod_links(static_cast<int>(guides.links)) {
        for (uint32_t i = 0; i < guides.links; ++i) {
            rests.push_back({guides.rest.at(0, i)[index], guides.rest.at(1, i)[index],
                             guides.rest.at(2, i)[index]});
            preloads.push_back({guides.preload.at(0, i)[index], guides.preload.at(1, i)[index],
                                guides.preload.at(2, i)[index]});
        }
        rotations.assign(guides.links, {0.0, 0.0, 0.0, 1.0});
        velocities.assign(guides.links, {0.0, 0.0, 0.0});
        tensions.assign(guides.links, 0.0);
    }

    /// One frame; what `simulate` does.
    void advance(const RodParams& params, const RodRoot& root, std::vector<RodCapsule> with = {}) {
        rod_params = params;
        capsules = std::move(with);
        rod_turn = {root.turn.x, root.turn.y, root.turn.z, root.turn.w};
        rod_spin = {root.spin.x, root.spin.y, root.spin.z, root.spin.w};
        rod_place0 = rod_spread(root.place0);
        rod_place1 = rod_spread(root.place1);
        rod_frame();
    }

    /// Points from the root, in its frame.
    [[nodiscard]] std::vector<glm::dvec3> points() const {
        std::vector<glm::dvec3> result{glm::dvec3(0.0)};
        for (size_t i = 0; i < rests.size(); ++i) {
            const rvec3 link = rod_rotate(rotations[i], rests[i]);
            result.push_back(result.back() + glm::dvec3(link.x, link.y, link.z));
        }
        return result;
    }

    std::vector<rvec3> rests, preloads, velocities;
    std::vector<rvec4> rotations;
    std::vector<double> tensions;
    std::vector<RodCapsule> capsules;

    RodParams rod_params{};
    int rod_links;
    uint32_t rod_near = 0;
    rvec4 rod_turn, rod_spin;
    rvec3 rod_place0, rod_place1;
    std::array<rvec3, kRodMaxLinks> rod_olds, rod_offsets, rod_spins, rod_forces;
    std::array<RodGain, kRodMaxLinks> rod_gains;

    rvec3 rod_rest(int i) const { return rests[static_cast<size_t>(i)]; }
    rvec3 rod_preload(int i) const { return preloads[static_cast<size_t>(i)]; }
    rvec4 rod_rotation(int i) const { return rotations[static_cast<size_t>(i)]; }
    rvec3 rod_velocity(int i) const { return velocities[static_cast<size_t>(i)]; }
    double rod_tension(int i) const { return tensions[static_cast<size_t>(i)]; }
    void rod_set_rotation(int i, rvec4 q) { rotations[static_cast<size_t>(i)] = q; }
    void rod_set_velocity(int i, rvec3 v) { velocities[static_cast<size_t>(i)] = v; }
    void rod_set_tension(int i, double t) { tensions[static_cast<size_t>(i)] = t; }
    RodCapsuleStep rod_capsule(int c, float begin, float end) const {
        const RodCapsule& capsule = capsules[static_cast<size_t>(c)];
        const auto at = [](vec3 a, vec3 b, float t) { return rod_spread(a + (b - a) * t); };
        return {at(capsule.a0, capsule.a1, end), at(capsule.b0, capsule.b1, end),
                rod_spread((capsule.a1 - capsule.a0) * (end - begin)),
                rod_spread((capsule.b1 - capsule.b0) * (end - begin)), capsule.radius};
    }

#include "hair/dynamics/rod_step.glsl"
};

}  // namespace vellus::hair::rod_double
