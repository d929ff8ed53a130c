#include "modules/hair/binding/nearest_triangle.h"

#include <gtest/gtest.h>

#include "tests/support/sampling.h"

namespace vellus::hair {
namespace {

using test::Random;

glm::dvec3 in_cube(Random& random) {
    return {random.range(-1, 1), random.range(-1, 1), random.range(-1, 1)};
}

TEST(NearestOnTriangle, NoPointOfTheTriangleIsCloser) {
    for (uint64_t sample = 0; sample < 3000; ++sample) {
        Random random(1, sample);
        const glm::dvec3 a = in_cube(random);
        const glm::dvec3 b = in_cube(random);
        const glm::dvec3 c = in_cube(random);
        const glm::dvec3 p = 2.0 * in_cube(random);
        const SurfacePoint found = nearest_on_triangle(p, a, b, c);
        const glm::dvec2 at = found.barycentric;
        ASSERT_GE(at.x, 0.0);
        ASSERT_GE(at.y, 0.0);
        ASSERT_LE(at.x + at.y, 1.0 + 1e-12);
        ASSERT_NEAR(found.distance, glm::distance(p, a + at.x * (b - a) + at.y * (c - a)), 1e-12);
        for (int i = 0; i <= 20; ++i) {
            for (int k = 0; k <= 20 - i; ++k) {
                const glm::dvec3 q = a + (b - a) * (i / 20.0) + (c - a) * (k / 20.0);
                ASSERT_LE(found.distance, glm::distance(p, q) + 1e-12);
            }
        }
    }
}

TEST(TriangleTree, FindsWhatLookingAtAllTrianglesFinds) {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    Random random(2, 0);
    for (uint32_t t = 0; t < 700; ++t) {
        const glm::dvec3 center = in_cube(random);
        for (int k = 0; k < 3; ++k) positions.push_back(center + 0.1 * in_cube(random));
        triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
    }
    const TriangleTree tree(positions, triangles);
    for (uint64_t sample = 0; sample < 2000; ++sample) {
        Random at(3, sample);
        const glm::dvec3 p = 1.5 * in_cube(at);
        double nearest = 1e9;
        for (const glm::uvec3& t : triangles) {
            nearest = std::min(
                nearest,
                nearest_on_triangle(p, positions[t.x], positions[t.y], positions[t.z]).distance);
        }
        const SurfacePoint found = tree.nearest(p);
        ASSERT_EQ(found.distance, nearest);
    }
}

TEST(TriangleTree, LeavesOutTrianglesWithoutArea) {
    const std::vector<glm::dvec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    const std::vector<glm::uvec3> degenerate = {{0, 1, 2}, {0, 0, 3}, {1, 1, 1}};
    EXPECT_TRUE(TriangleTree(positions, degenerate).empty());
    EXPECT_TRUE(TriangleTree(positions, {}).empty());
    const std::vector<glm::uvec3> one = {{0, 1, 2}, {0, 1, 3}};
    const TriangleTree tree(positions, one);
    EXPECT_EQ(tree.nearest({1.5, 0, 0}).triangle, 1u);
}

TEST(TriangleTree, ManyTrianglesInOnePlaceEnd) {
    const std::vector<glm::dvec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::uvec3> triangles(5000, glm::uvec3(0, 1, 2));
    const TriangleTree tree(positions, triangles);
    EXPECT_DOUBLE_EQ(tree.nearest({0.2, 0.2, 3.0}).distance, 3.0);
}

}  // namespace
}  // namespace vellus::hair
