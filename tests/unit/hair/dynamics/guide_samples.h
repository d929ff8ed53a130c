#pragma once

#include <cmath>
#include <vector>

#include "modules/hair/dynamics/guide_motion.h"
#include "tests/support/sampling.h"

namespace vellus::hair::test {

using Strand = std::vector<glm::vec3>;

/// A straight strand of `points` points.
inline Strand straight(glm::vec3 root, glm::vec3 tip, int points = 16) {
    Strand strand;
    for (int i = 0; i < points; ++i) {
        strand.push_back(
            glm::mix(root, tip, static_cast<float>(i) / static_cast<float>(points - 1)));
    }
    return strand;
}

/// Hair on a sphere of radius 0.09 round the origin: rises off it, falls 0.25 m, waves and curls.
inline std::vector<Strand> sample_hair(uint32_t count, int points = 24) {
    std::vector<Strand> strands;
    for (uint32_t s = 0; s < count; ++s) {
        vellus::test::Random random(7, s);
        glm::dvec3 out = random.direction();
        out.y = std::abs(out.y);
        const double length = random.range(0.05, 0.3);
        const double curl = random.range(0.0, 0.012);
        const double turns = random.range(1.0, 5.0);
        Strand strand;
        for (int i = 0; i < points; ++i) {
            const double t = static_cast<double>(i) / (points - 1);
            const double a = 6.2831853 * turns * t;
            glm::dvec3 p = 0.09 * out + length * (0.3 * (1.0 - std::exp(-3.0 * t)) * out);
            p.y -= length * t * t;
            strand.emplace_back(p + curl * t * glm::dvec3(std::cos(a), 0.0, std::sin(a)));
        }
        strands.push_back(strand);
    }
    return strands;
}

/// Gravity as if guides stood upright.
inline void preload_upright(GuideSet& guides) {
    set_preload(guides, std::vector<glm::vec3>(guides.count, glm::vec3(0.0f, -9.81f, 0.0f)));
}

/// Still air, gravity, the default hair.
inline glsl::RodParams sample_params(const MotionSettings& settings = {}) {
    glsl::RodParams p{};
    p.gravity = {0.0f, -9.81f, 0.0f};
    p.step = static_cast<float>(kMotionStep);
    p.drag = settings.drag;
    p.stiffness = std::pow(settings.bend_length, 3.0f) * 9.81f;
    p.twist = settings.twist;
    p.damping = settings.damping;
    p.hold = settings.hold;
    p.friction = settings.friction;
    p.inertia = p.memory = p.scale = 1.0f;
    p.substeps = 4;
    return p;
}

constexpr glm::vec4 kNoTurn{0.0f, 0.0f, 0.0f, 1.0f};

inline glm::vec4 to_vec4(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// From one turn to another in `steps` substeps.
inline glm::vec4 spin_between(const glm::dquat& from, const glm::dquat& to, uint32_t steps) {
    return to_vec4(glm::slerp(glm::dquat(1, 0, 0, 0), to * glm::conjugate(from), 1.0 / steps));
}

inline glsl::RodRoot still_root(glm::vec3 place = glm::vec3(0.0f)) {
    return {.turn = kNoTurn, .spin = kNoTurn, .place0 = place, .place1 = place};
}

inline glm::dquat turn_about(glm::dvec3 axis, double angle) {
    return glm::angleAxis(angle, glm::normalize(axis));
}

/// Roots of `guides` on a body at `place` turned by `turn`.
inline std::vector<RootPose> roots_on(const GuideSet& guides, const glm::dvec3& place,
                                      const glm::dquat& turn) {
    std::vector<RootPose> roots;
    for (const glm::vec3& root : guides.root)
        roots.push_back({place + turn * glm::dvec3(root), turn});
    return roots;
}

/// Greatest |length of a link / its rest length - 1|, over links longer than a micrometre.
inline double length_error(const GuideSet& guides, const GuideState& state) {
    double worst = 0.0;
    for (uint32_t g = 0; g < guides.count; ++g) {
        const auto points = guide_points(guides, state, g);
        for (uint32_t i = 0; i < guides.links; ++i) {
            const glm::dvec3 rest(guides.rest.at(0, i)[g], guides.rest.at(1, i)[g],
                                  guides.rest.at(2, i)[g]);
            if (glm::length(rest) < 1e-6) continue;
            const double now = glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i + 1]));
            worst = std::max(worst, std::abs(now / glm::length(rest) - 1.0));
        }
    }
    return worst;
}

/// Greatest distance of a point from where it is groomed, in roots' frames.
inline double distance_from_rest(const GuideSet& guides, const GuideState& state) {
    const GuideState rest = rest_state(guides);
    double worst = 0.0;
    for (uint32_t g = 0; g < guides.count; ++g) {
        const auto a = guide_points(guides, state, g);
        const auto b = guide_points(guides, rest, g);
        for (size_t i = 0; i < a.size(); ++i) {
            worst = std::max(worst, static_cast<double>(glm::distance(a[i], b[i])));
        }
    }
    return worst;
}

inline bool all_finite(const GuideState& state) {
    const auto finite = [](const GuideColumns& c) {
        for (const float x : c.data) {
            if (!std::isfinite(x)) return false;
        }
        return true;
    };
    return finite(state.rotation) && finite(state.velocity) && finite(state.tension);
}

}  // namespace vellus::hair::test
