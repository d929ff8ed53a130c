#include "modules/hair/reference/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/sampling.h"

namespace vellus::hair::reference {
namespace {

/// Whether a point lies in the hull of two balls: within one of the balls in between, found by
/// minimising distance less radius over the axis (a convex function).
bool inside(const RoundSegment& s, const glm::dvec3& point) {
    double low = 0.0;
    double high = 1.0;
    const auto gap = [&](double t) {
        return glm::distance(point, glm::mix(s.a, s.b, t)) - glm::mix(s.radius_a, s.radius_b, t);
    };
    for (int i = 0; i < 60; ++i) {
        const double third = (high - low) / 3.0;
        const bool nearer_low = gap(low + third) < gap(high - third);
        if (nearer_low) high -= third;
        if (!nearer_low) low += third;
    }
    return gap(0.5 * (low + high)) < 0.0;
}

RoundSegment random_segment(test::Random& random) {
    RoundSegment s;
    s.a = random.direction() * random.range(0.0, 0.6);
    s.b = s.a + random.direction() * random.range(0.01, 0.8);
    s.radius_a = random.range(0.0, 0.3);
    s.radius_b = random.range(0.0, 0.3);
    s.opacity = random.unit();
    return s;
}

TEST(Visibility, IntervalsAreThoseFoundByWalkingAlongTheRay) {
    int hits = 0;
    for (int i = 0; i < 600; ++i) {
        test::Random random(11, i);
        const RoundSegment s = random_segment(random);
        const glm::dvec3 origin = random.direction() * 3.0;
        const glm::dvec3 direction = random.direction() * 0.2 - origin;
        constexpr int kSteps = 1000;
        double first = 2.0;
        double last = 0.0;
        for (int k = 0; k < kSteps; ++k) {
            const double t = 2.0 * (k + 0.5) / kSteps;
            if (!inside(s, origin + t * direction)) continue;
            first = std::min(first, t);
            last = std::max(last, t);
        }
        double enter = 0.0;
        double leave = 0.0;
        const bool hit = intersect(s, origin, direction, enter, leave);
        const double step = 2.0 / kSteps;
        if (first > last) {
            // Walking may step over a chord shorter than a step.
            EXPECT_TRUE(!hit || leave - enter <= step) << i;
            continue;
        }
        ++hits;
        ASSERT_TRUE(hit) << i;
        EXPECT_NEAR(enter, first, step) << i;
        EXPECT_NEAR(leave, last, step) << i;
    }
    EXPECT_GT(hits, 100);
}

TEST(Visibility, TransmittanceIsTheProductOverStrandsBefore) {
    // Against a direct product over strands, each found by its own earliest entry.
    for (int round = 0; round < 50; ++round) {
        test::Random random(12, round);
        std::vector<RoundSegment> segments;
        for (uint32_t strand = 0; strand < 40; ++strand) {
            RoundSegment s = random_segment(random);
            s.radius_a *= 0.1;
            s.radius_b *= 0.1;
            s.strand = strand;
            segments.push_back(s);
        }
        const glm::dvec3 origin(0.0, 0.0, 4.0);
        const glm::dvec3 direction(random.range(-0.05, 0.05), random.range(-0.05, 0.05), -1.0);
        const Transmittance v = transmittance_along(segments, origin, direction);
        EXPECT_TRUE(std::ranges::is_sorted(v.depths()));
        for (const double depth : {0.0, 3.2, 3.7, 4.0, 4.4, 10.0}) {
            double product = 1.0;
            for (const RoundSegment& s : segments) {
                double enter = 0.0;
                double leave = 0.0;
                if (intersect(s, origin, direction, enter, leave) && enter < depth) {
                    product *= 1.0 - s.opacity;
                }
            }
            EXPECT_NEAR(v.at(depth), product, 1e-12);
        }
    }
}

TEST(Visibility, OneStrandCountsOnceThoughItsPiecesOverlap) {
    const glm::dvec3 joint(0.0, 0.0, 0.0);
    const std::vector<RoundSegment> bent = {
        {{-1.0, 0.0, 0.0}, joint, 0.1, 0.1, 0.5, 7},
        {joint, {0.0, 1.0, 0.0}, 0.1, 0.1, 0.5, 7},
    };
    const auto through_joint = transmittance_along(bent, {0.0, 0.0, 2.0}, {0.0, 0.0, -1.0});
    EXPECT_DOUBLE_EQ(through_joint.at(5.0), 0.5);
    // A ray that leaves the strand and meets it again is stopped twice.
    const auto twice =
        transmittance_along(bent, {-1.0, -1.0, 0.0}, glm::normalize(glm::dvec3(1.0, 2.0, 0.0)));
    EXPECT_DOUBLE_EQ(twice.at(10.0), 0.25);
}

TEST(Visibility, StepsLieAtTheFirstSurfaceAndNotBefore) {
    const std::vector<RoundSegment> one = {{{-1, 0, 0}, {1, 0, 0}, 0.25, 0.25, 1.0, 0}};
    const auto v = transmittance_along(one, {0.3, 0.0, 1.0}, {0.0, 0.0, -1.0});
    ASSERT_EQ(v.depths().size(), 1u);
    EXPECT_NEAR(v.depths()[0], 0.75, 1e-15);
    EXPECT_DOUBLE_EQ(v.at(0.75), 1.0);
    EXPECT_DOUBLE_EQ(v.at(0.7500001), 0.0);
    // Starting inside: the own strand does not count.
    EXPECT_DOUBLE_EQ(transmittance_along(one, {0.0, 0.0, 0.1}, {0, 0, -1}).at(9.0), 1.0);
    EXPECT_DOUBLE_EQ(Transmittance().at(1.0), 1.0);
}

TEST(Visibility, DegenerateSegmentsAreBalls) {
    const RoundSegment ball{{0, 0, 0}, {0, 0, 0}, 0.5, 0.5, 1.0, 0};
    double enter = 0.0;
    double leave = 0.0;
    EXPECT_TRUE(intersect(ball, {0, 0, 2}, {0, 0, -1}, enter, leave));
    EXPECT_NEAR(enter, 1.5, 1e-15);
    const RoundSegment inner{{0, 0, 0}, {0.1, 0, 0}, 0.5, 0.1, 1.0, 0};
    EXPECT_TRUE(intersect(inner, {2, 0, 0}, {-1, 0, 0}, enter, leave));
    EXPECT_NEAR(leave - enter, 1.0, 1e-15);
    EXPECT_FALSE(intersect(ball, {0.5, 0, 2}, {0, 0, -1}, enter, leave));
}

}  // namespace
}  // namespace vellus::hair::reference
