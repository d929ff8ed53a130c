#include "assets/generator/body_colliders.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assets/generator/bust.h"
#include "assets/generator/hair_style.h"
#include "assets/generator/sdf.h"
#include "tests/support/sampling.h"

namespace vellus::sculpt {
namespace {

using glm::dvec3;

double distance_to(const BodyCapsule& c, dvec3 p) {
    return capsule(p, c.from, c.to, c.radius, c.radius);
}

double distance_to(const std::vector<BodyCapsule>& capsules, dvec3 p) {
    double nearest = 1e9;
    for (const BodyCapsule& c : capsules) nearest = std::min(nearest, distance_to(c, p));
    return nearest;
}

TEST(BodyColliders, StayInTheBody) {
    for (const BodyCapsule& c : body_capsules()) {
        for (uint64_t sample = 0; sample < 4000; ++sample) {
            test::Random random(5, sample);
            const dvec3 p =
                glm::mix(c.from, c.to, random.range(0, 1)) + random.direction() * c.radius;
            if (distance_to(c, p) < -1e-9 || p.y < -0.40) continue;
            // An ear is thinner than its capsule.
            EXPECT_LT(bust_distance(p), 0.004) << c.name;
        }
    }
}

TEST(BodyColliders, LeaveNoHollowWhereHairFalls) {
    const std::vector<BodyCapsule> capsules = body_capsules();
    size_t points = 0;
    size_t hollow = 0;
    for (uint64_t sample = 0; sample < 60'000; ++sample) {
        test::Random random(7, sample);
        const dvec3 p(random.range(-0.13, 0.13), random.range(-0.32, 0.12),
                      random.range(-0.14, 0.03));
        if (std::abs(bust_distance(p)) > 0.001) continue;
        ++points;
        if (distance_to(capsules, p) > 0.015) ++hollow;
    }
    ASSERT_GT(points, 500U);
    EXPECT_LT(static_cast<double>(hollow), 0.1 * static_cast<double>(points));
}

TEST(BodyColliders, TheGroomLiesOutside) {
    const std::vector<BodyCapsule> capsules = body_capsules();
    for (const auto& strand : grow_hair({.directions = 600, .points = 14, .length = 0.80})) {
        // Roots are on the skin; hair leaves it within a few points.
        for (size_t i = 2; i < strand.size(); ++i) {
            EXPECT_GT(distance_to(capsules, strand[i]), -0.004);
        }
    }
}

}  // namespace
}  // namespace vellus::sculpt
