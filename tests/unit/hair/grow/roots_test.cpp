#include "modules/hair/grow/roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/hair/grow/closest.h"
#include "modules/hair/grow/head.h"

namespace vellus::hair::grow {
namespace {

constexpr float kRadius = 0.09f;

/// Which of 48 cells of equal area a direction lies in: six bands by height, eight sectors.
size_t cell_of(glm::dvec3 p) {
    const double height = std::clamp(p.y / glm::length(p), -1.0, 0.999999);
    const double turn = std::atan2(p.z, p.x) / (2.0 * std::acos(-1.0)) + 0.5;
    const auto band = static_cast<size_t>((height + 1.0) / 2.0 * 6.0);
    return band * 8 + std::min<size_t>(static_cast<size_t>(turn * 8.0), 7);
}

TEST(ScatterRoots, EveryBeginningIsEvenOverTheArea) {
    const GrowSurface surface = sphere_surface(glm::vec3(0.0f), kRadius, true);
    const auto roots = scatter_roots(surface, 10'000, 3);
    ASSERT_EQ(roots.size(), 10'000u);
    for (const size_t count : {500u, 2'000u, 10'000u}) {
        std::vector<double> cells(48);
        for (size_t i = 0; i < count; ++i) cells[cell_of(roots[i].position)] += 1.0;
        const double expected = static_cast<double>(count) / 48.0;
        double chi = 0.0;
        for (const double n : cells) chi += (n - expected) * (n - expected) / expected;
        // For independent places chi-square has mean 47 and exceeds 64 once in twenty times; points
        // that keep apart are far more even.
        EXPECT_LT(chi, 24.0) << count;
    }
}

TEST(ScatterRoots, FollowsTheDensity) {
    GrowSurface surface = sphere_surface(glm::vec3(0.0f), kRadius, true);
    // A quarter as dense on the left as on the right.
    surface.mask = [](glm::vec3 p, glm::vec2) { return p.x < 0.0f ? 0.25f : 1.0f; };
    const auto roots = scatter_roots(surface, 8'000, 4);
    double left = 0.0;
    for (const Root& root : roots) left += root.position.x < 0.0 ? 1.0 : 0.0;
    EXPECT_NEAR(left / 8'000.0, 0.2, 0.01);
}

TEST(ScatterRoots, KeepsItsDistance) {
    const GrowSurface surface = sphere_surface(glm::vec3(0.0f), kRadius, true);
    const size_t count = 2'000;
    const auto roots = scatter_roots(surface, count, 5);
    const double densest = std::sqrt(haired_area(surface) / count / 0.866);
    double nearest = 1.0;
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j < i; ++j) {
            nearest = std::min(nearest, glm::distance(roots[i].position, roots[j].position));
        }
    }
    // Independent places would have a pair at 1/1500 of it.
    EXPECT_GT(nearest, 0.35 * densest);
}

TEST(ScatterRoots, StaysInsideTheMask) {
    GrowSurface surface = sphere_surface(glm::vec3(0.0f), kRadius, true);
    surface.mask = [](glm::vec3 p, glm::vec2) { return p.y > 0.05f ? 1.0f : 0.0f; };
    const auto roots = scatter_roots(surface, 3'000, 6);
    ASSERT_EQ(roots.size(), 3'000u);
    for (const Root& root : roots) EXPECT_GT(root.position.y, 0.0499);
    // A cap of height h has the area 2 pi r h.
    const double cap = 2.0 * std::acos(-1.0) * 0.09 * 0.04;
    EXPECT_NEAR(haired_area(surface), cap, 0.02 * cap);
}

TEST(FitHead, FindsTheBallUnderASkullcap) {
    const GrowSurface surface = sphere_surface(glm::vec3(0.3f, 1.6f, -2.0f), kRadius, false);
    const Head head = fit_head(scatter_roots(surface, 500, 1));
    EXPECT_LT(glm::distance(head.center, glm::dvec3(0.3, 1.6, -2.0)), 1e-3 * kRadius);
    EXPECT_NEAR(head.radius, kRadius, 1e-3 * kRadius);
}

TEST(ClosestPoint, AgreesWithTheBallAndWithAllTriangles) {
    const GrowSurface surface = sphere_surface(glm::vec3(0.0f), kRadius, true);
    const ClosestPoint body(surface);
    for (uint32_t i = 0; i < 500; ++i) {
        const double h = 1.0 - 2.0 * (i + 0.5) / 500.0;
        const double r = std::sqrt(1.0 - h * h);
        const glm::dvec3 direction(r * std::cos(2.4 * i), h, r * std::sin(2.4 * i));
        const double radius = kRadius * (0.3 + 1.4 * ((i * 37) % 101) / 101.0);
        const Closest found = body(direction * radius, 1.0);
        ASSERT_TRUE(found.found);
        // The ball's triangles lie up to 1 - cos(pi / 96) of its radius inside it.
        EXPECT_NEAR(found.distance, radius - kRadius, 2e-3 * kRadius);
        EXPECT_GT(glm::dot(found.normal, direction), 0.995);
        double nearest = 1e9;
        for (const glm::vec3& v : surface.positions) {
            nearest = std::min(nearest, glm::distance(glm::dvec3(v), direction * radius));
        }
        EXPECT_LE(std::abs(found.distance), nearest + 1e-7) << "no vertex is nearer";
    }
    EXPECT_FALSE(body(glm::dvec3(1.0), 0.5).found) << "out of reach";
}

TEST(ClosestPoint, PushesOutToTheClearanceAndNoFurther) {
    const GrowSurface surface = sphere_surface(glm::vec3(0.0f), kRadius, true);
    const ClosestPoint body(surface);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    for (const double radius : {0.07, 0.089, 0.0905}) {
        const glm::dvec3 out = body.push_out(direction * radius, 0.004, 0.05);
        EXPECT_NEAR(glm::length(out), kRadius + 0.004, 2e-4);
        EXPECT_LT(glm::distance(glm::normalize(out), direction), 0.02);
    }
    const glm::dvec3 far = direction * 0.12;
    EXPECT_EQ(body.push_out(far, 0.004, 0.05), far);
}

}  // namespace
}  // namespace vellus::hair::grow
