#include "modules/hair/reference/tracer/geometry.h"

#include <gtest/gtest.h>

#include <limits>

#include "modules/hair/reference/visibility.h"
#include "tests/unit/tracer/scenes.h"

namespace vellus::hair::tracer {
namespace {

/// Separate tapered segments, and the same for the brute-force reference.
struct Strands {
    Scene scene;
    std::vector<reference::RoundSegment> segments;
};

Strands random_strands(uint64_t seed) {
    Strands result;
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < 60; ++i) {
        vellus::test::Random random(seed, i);
        const glm::vec3 a = glm::vec3(random.direction()) * static_cast<float>(random.unit());
        strands.push_back(
            {a, a + glm::vec3(random.direction()) * static_cast<float>(random.range(0.1, 0.8))});
    }
    result.scene.grooms.push_back(test::make_groom(strands, 0.0f));
    Groom& groom = result.scene.grooms[0];
    for (uint32_t i = 0; i < groom.segment_point.size(); ++i) {
        vellus::test::Random random(seed + 1, i);
        glm::vec4& a = groom.points[groom.segment_point[i]];
        glm::vec4& b = groom.points[groom.segment_point[i] + 1];
        a.w = static_cast<float>(random.range(0.005, 0.05));
        b.w = static_cast<float>(random.range(0.005, 0.05));
        result.segments.push_back({glm::dvec3(a), glm::dvec3(b), a.w, b.w, 1.0, i});
    }
    return result;
}

TEST(Geometry, FirstHitsAreThoseOfTheExactReference) {
    const Strands strands = random_strands(31);
    auto geometry = Geometry::build(strands.scene);
    ASSERT_TRUE(geometry) << geometry.error().message();
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        vellus::test::Random random(33, i);
        const glm::dvec3 origin = random.direction() * 3.0;
        const glm::dvec3 direction = glm::normalize(random.direction() - origin);
        const auto exact = reference::crossings(strands.segments, origin, direction);
        const Ray ray{.origin = origin, .direction = direction};
        Hit hit;
        const bool met = (*geometry)->closest(ray, hit);
        // A graze within rounding may go either way.
        if (!exact.empty() && exact[0].leave - exact[0].enter < 1e-3) continue;
        ASSERT_EQ(met, !exact.empty()) << i;
        if (!met) continue;
        ++hits;
        EXPECT_NEAR(hit.distance, exact[0].enter, 1e-4) << i;
        EXPECT_EQ(hit.primitive, exact[0].strand) << i;
        EXPECT_LT(glm::dot(hit.normal, direction), 0.0);
        EXPECT_TRUE((*geometry)->blocked(ray, exact[0].enter + 1e-3));
        EXPECT_FALSE((*geometry)->blocked(ray, exact[0].enter - 1e-3));
    }
    EXPECT_GT(hits, 1000);
}

TEST(Geometry, ARayLeavesItsStrandThroughTheInside) {
    Scene scene;
    scene.grooms.push_back(
        test::make_groom({{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{-1, 0, -1}, {1, 0, -1}}}, 0.1f));
    auto geometry = Geometry::build(scene);
    ASSERT_TRUE(geometry);
    // From the front of the first, on through it: the second is met, not the own back.
    Ray ray{.origin = {0.01, 0.0, 0.1}, .direction = {0, 0, -1}, .near = 1e-6};
    Hit hit;
    ASSERT_TRUE((*geometry)->closest(ray, hit));
    EXPECT_EQ(scene.grooms[0].segment_strand[hit.primitive], 1u);
    EXPECT_NEAR(hit.distance, 1.0, 1e-5);
    // Its own strand counts again beyond `until`.
    ray = {.origin = {0, 0, 1}, .direction = {0, 0, -1}, .own = {0, 0, 5.0}};
    ASSERT_TRUE((*geometry)->closest(ray, hit));
    EXPECT_EQ(scene.grooms[0].segment_strand[hit.primitive], 1u);
    ray.own.until = 0.5;
    ASSERT_TRUE((*geometry)->closest(ray, hit));
    EXPECT_EQ(scene.grooms[0].segment_strand[hit.primitive], 0u);
}

TEST(Geometry, MasksAndBlendsStopTheirShare) {
    Scene scene;
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.base_color.a = 0.4f;
    mesh.two_sided = true;
    const auto share = [&](float cutoff) {
        scene.meshes[0].alpha_cutoff = cutoff;
        auto geometry = Geometry::build(scene);
        EXPECT_TRUE(geometry);
        int met = 0;
        for (uint64_t i = 0; i < 2000; ++i) {
            met += (*geometry)->blocked({.origin = {0, 0, 1}, .seed = i},
                                        std::numeric_limits<double>::infinity())
                       ? 1
                       : 0;
        }
        return met / 2000.0;
    };
    EXPECT_EQ(share(0.0f), 1.0);
    EXPECT_EQ(share(0.5f), 0.0);
    EXPECT_EQ(share(0.3f), 1.0);
    EXPECT_NEAR(share(-1.0f), 0.4, 4.5 * std::sqrt(0.24 / 2000));
}

TEST(Geometry, AnEmptySceneMeetsNothing) {
    const Scene scene;
    auto geometry = Geometry::build(scene);
    ASSERT_TRUE(geometry);
    Hit hit;
    EXPECT_FALSE((*geometry)->closest({}, hit));
}

}  // namespace
}  // namespace vellus::hair::tracer
