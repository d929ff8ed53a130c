#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/hair/dynamics/simulate.h"
#include "tests/unit/hair/dynamics/guide_samples.h"
#include "tests/unit/hair/dynamics/rod_double.h"

// One strand against the theory of beams, and what must hold of any.
namespace vellus::hair {
namespace {

using rod_double::Guide;
using test::sample_params;
using test::still_root;

/// Shape of a heavy elastic line clamped level at its root: EI θ'' = -w (L - s) cos θ, θ(0) = 0,
/// θ'(L) = 0, by shooting with fourth-order Runge-Kutta. Returns the tip, x along and y down.
struct Elastica {
    double length;
    double weight_over_stiffness;  // w / EI

    struct End {
        double slope;
        glm::dvec2 tip;
    };
    [[nodiscard]] End shoot(double curvature) const {
        constexpr int kSteps = 2000;
        const double h = length / kSteps;
        glm::dvec4 y(0.0, curvature, 0.0, 0.0);  // θ, θ', x, down
        const auto f = [&](double s, const glm::dvec4& v) {
            return glm::dvec4(v.y, -weight_over_stiffness * (length - s) * std::cos(v.x),
                              std::cos(v.x), std::sin(v.x));
        };
        for (int i = 0; i < kSteps; ++i) {
            const double s = i * h;
            const glm::dvec4 k1 = f(s, y);
            const glm::dvec4 k2 = f(s + h / 2, y + k1 * (h / 2));
            const glm::dvec4 k3 = f(s + h / 2, y + k2 * (h / 2));
            const glm::dvec4 k4 = f(s + h, y + k3 * h);
            y += (k1 + 2.0 * k2 + 2.0 * k3 + k4) * (h / 6);
        }
        return {y.y, {y.z, y.w}};
    }
    [[nodiscard]] glm::dvec2 tip() const {
        double low = 0.0;
        double high = weight_over_stiffness * length * length;
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            (shoot(middle).slope < 0.0 ? low : high) = middle;
        }
        return shoot(low).tip;
    }
};

/// Tip of a level strand 0.2 m long after it has settled.
glm::dvec2 settled_tip(uint32_t links, double bend_length) {
    const std::vector<test::Strand> strands{test::straight({0, 0, 0}, {0.2f, 0, 0})};
    Guide guide(make_guides(strands, links), 0);
    glsl::RodParams params = sample_params({.bend_length = static_cast<float>(bend_length),
                                            .damping = 0.02f,
                                            .drag = 6.0f,
                                            .hold = 0.0f});
    for (int frame = 0; frame < 600; ++frame) guide.advance(params, still_root());
    for (const auto& v : guide.velocities) EXPECT_LT(rod_double::rod_length(v), 1e-4);
    const glm::dvec3 tip = guide.points().back();
    return {tip.x, -tip.y};
}

TEST(Rod, DroopsLikeTheElastica) {
    for (const double bend_length : {0.2, 0.1, 0.06}) {
        const Elastica line{0.2, 1.0 / (bend_length * bend_length * bend_length)};
        const glm::dvec2 expected = line.tip();
        const double coarse = glm::distance(settled_tip(15, bend_length), expected);
        const double fine = glm::distance(settled_tip(30, bend_length), expected);
        // Straight links of 1/15 of the length: an error of second order in their size, which half
        // the size must make a quarter of. 1 % of the strand is what the eye could compare.
        EXPECT_LT(coarse, 0.01 * 0.2) << bend_length;
        EXPECT_LT(fine, 0.35 * coarse) << bend_length;
        EXPECT_GT(expected.y, 0.02) << "a case that bends, or the test shows nothing";
    }
}

/// Kinetic, elastic and potential energy per mass per length, from the definitions.
double energy(const Guide& guide, const glsl::RodParams& p) {
    const auto points = guide.points();
    const auto links = static_cast<size_t>(guide.rod_links);
    double sum = 0.0;
    const auto size = [&](size_t i) {
        return i < links ? rod_double::rod_length(guide.rests[i]) : 0.0;
    };
    for (size_t i = 0; i < links; ++i) {
        const double mass = 0.5 * (size(i) + size(i + 1));
        const auto& v = guide.velocities[i];
        sum += 0.5 * mass * rod_double::rod_dot(v, v) -
               mass * glm::dot(glm::dvec3(p.gravity), points[i + 1]);
        const glm::dquat before =
            i == 0 ? glm::dquat(1, 0, 0, 0)
                   : glm::dquat(guide.rotations[i - 1].w, guide.rotations[i - 1].x,
                                guide.rotations[i - 1].y, guide.rotations[i - 1].z);
        const glm::dquat now(guide.rotations[i].w, guide.rotations[i].x, guide.rotations[i].y,
                             guide.rotations[i].z);
        const glm::dquat bend = now * glm::conjugate(before);
        const double angle =
            2.0 * std::atan2(glm::length(glm::dvec3(bend.x, bend.y, bend.z)), std::abs(bend.w));
        const double joint = 0.5 * (size(i) + (i > 0 ? size(i - 1) : 0.0));
        sum += 0.5 * static_cast<double>(p.stiffness) / joint * angle * angle;
    }
    return sum;
}

/// Energies of a strand let go from a wild shape, without damping or air.
struct Fall {
    double first = 0.0;
    double last = 0.0;
    double lowest = 0.0;  ///< of any shape: hanging straight
    double risen = 0.0;   ///< most above the least so far
};

Fall let_go(uint64_t sample, float step) {
    vellus::test::Random random(3, sample);
    const std::vector<test::Strand> strands{test::straight({0, 0, 0}, {0, -0.25f, 0})};
    const auto bend_length = static_cast<float>(random.log_range(0.02, 0.3));
    Guide guide(make_guides(strands), 0);
    // Twist as stiff as bend, so that elastic energy is that of the angle.
    glsl::RodParams params = sample_params(
        {.bend_length = bend_length, .twist = 1.0f, .damping = 0.0f, .drag = 0.0f, .hold = 0.0f});
    params.substeps = 1;
    params.step = step;
    Fall fall{.lowest = energy(guide, params)};
    glm::dquat turn(1, 0, 0, 0);
    for (auto& q : guide.rotations) {
        turn = test::turn_about(random.direction(), random.range(0.0, 0.5)) * turn;
        q = {turn.x, turn.y, turn.z, turn.w};
    }
    double least = fall.first = energy(guide, params);
    for (int i = 0; i < 2000; ++i) {
        guide.advance(params, still_root());
        fall.last = energy(guide, params);
        least = std::min(least, fall.last);
        fall.risen = std::max(fall.risen, fall.last - least);
    }
    return fall;
}

TEST(Rod, EnergyOnlyFalls) {
    // Also at a step of a quarter: there implicit steps lose less, and hide less of what is won.
    for (const float step : {1.0f / 240.0f, 1.0f / 960.0f}) {
        for (uint64_t sample = 0; sample < 20; ++sample) {
            const Fall fall = let_go(sample, step);
            // A step is one linear solve; where a tip cracks like a whip it misses a little.
            EXPECT_LE(fall.risen, 0.01 * (fall.first - fall.lowest)) << sample << ", " << step;
            EXPECT_LT(fall.last, fall.first - 0.05 * (fall.first - fall.lowest)) << sample;
            EXPECT_GE(fall.last, fall.lowest - 1e-9) << sample;
        }
    }
}

TEST(Rod, TwistAtTheRootTurnsABentTip) {
    // An L: along X, then along Z. Turned at the root about X, without gravity and hold, only
    // twist along the straight part can bring the bent part after.
    test::Strand strand = test::straight({0, 0, 0}, {0.15f, 0, 0}, 11);
    for (int i = 1; i <= 5; ++i) strand.emplace_back(0.15f, 0.0f, 0.015f * static_cast<float>(i));
    const std::vector<test::Strand> strands{strand};
    Guide guide(make_guides(strands), 0);
    glsl::RodParams params = sample_params({.hold = 0.0f});
    params.gravity = glm::vec3(0.0f);
    const glm::dquat quarter = test::turn_about({1, 0, 0}, 1.2);
    glsl::RodRoot root = still_root();
    root.spin = test::spin_between({1, 0, 0, 0}, quarter, params.substeps);
    guide.advance(params, root);
    root.turn = test::to_vec4(quarter);
    root.spin = test::kNoTurn;
    const double at_once = guide.points().back().z;
    for (int frame = 0; frame < 600; ++frame) guide.advance(params, root);
    // In its root's frame the strand is as groomed again; just after the turn it was left behind.
    EXPECT_NEAR(guide.points().back().z, 0.075, 1e-4);
    EXPECT_LT(at_once, 0.05);
}

TEST(Rod, LanesComputeWhatDoubleComputes) {
    const auto strands = test::sample_hair(13);
    GuideSet guides = make_guides(strands);
    test::preload_upright(guides);
    GuideState state = rest_state(guides);
    std::vector<Guide> exact;
    for (uint32_t g = 0; g < guides.count; ++g) exact.emplace_back(guides, g);
    glsl::RodParams params = sample_params();
    params.wind = {2.0f, 0.0f, 1.0f};
    params.gust = 0.6f;
    params.gust_rate = {0.001f, 0.003f, 0.007f};
    params.capsules = 1;
    const std::vector<glsl::RodCapsule> capsules{
        {.a0 = {0, 0, 0}, .radius = 0.085f, .b0 = {0, 0, 0}, .a1 = {0, 0, 0}, .b1 = {0, 0, 0}}};
    double worst = 0.0;
    glm::dquat before(1, 0, 0, 0);
    for (int frame = 0; frame < 120; ++frame) {
        const glm::dquat now = test::turn_about({0.2, 1, 0}, 0.8 * std::sin(0.1 * (frame + 1)));
        params.gust_phase = glm::vec3(static_cast<float>(frame)) * params.gust_rate * 4.0f;
        std::vector<glsl::RodRoot> roots;
        for (uint32_t g = 0; g < guides.count; ++g) {
            const glm::dvec3 root(guides.root[g]);
            roots.push_back({.turn = test::to_vec4(before),
                             .spin = test::spin_between(before, now, params.substeps),
                             .place0 = glm::vec3(before * root),
                             .place1 = glm::vec3(now * root)});
            exact[g].advance(params, roots[g], capsules);
        }
        simulate(guides, params, roots, capsules, state);
        before = now;
        for (uint32_t g = 0; g < guides.count; ++g) {
            const auto a = guide_points(guides, state, g);
            const auto b = exact[g].points();
            for (size_t i = 0; i < a.size(); ++i) {
                worst = std::max(worst, glm::distance(glm::dvec3(a[i]), b[i]));
            }
        }
    }
    // Contacts switch on and off a step earlier or later by rounding; a hair's breadth is 1e-4 m.
    EXPECT_LT(worst, 2e-4);
}

TEST(Rod, GroomRestsAsGroomedUnderGravity) {
    const auto strands = test::sample_hair(64);
    GuideSet guides = make_guides(strands);
    test::preload_upright(guides);
    GuideState state = rest_state(guides);
    const std::vector<glsl::RodRoot> roots(guides.count, still_root());
    for (int frame = 0; frame < 240; ++frame) simulate(guides, sample_params(), roots, {}, state);
    EXPECT_LT(test::distance_from_rest(guides, state), 1e-4);
    // Without the preload the same hair sags: the test above is no accident of stiffness.
    for (float& m : guides.preload.data) m = 0.0f;
    for (int frame = 0; frame < 240; ++frame) simulate(guides, sample_params(), roots, {}, state);
    EXPECT_GT(test::distance_from_rest(guides, state), 0.01);
}

}  // namespace
}  // namespace vellus::hair
