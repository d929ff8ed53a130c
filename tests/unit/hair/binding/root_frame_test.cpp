#include "modules/hair/binding/root_frame.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "tests/support/sampling.h"

namespace vellus::hair {
namespace {

using test::Random;

glm::vec3 in_cube(Random& random) {
    return {random.range(-1, 1), random.range(-1, 1), random.range(-1, 1)};
}

struct Rest {
    glm::vec3 e1;
    glm::vec3 e2;
    glm::vec3 normal;
    glm::vec4 inverse;
    glm::mat3 axes;
};

/// Inverse of the edges' coordinates in the plane across the normal, as bind_roots makes it.
Rest rest_of(const glm::vec3& e1, const glm::vec3& e2, const glm::vec3& normal) {
    const glm::vec3 x = glsl::any_across(normal);
    const glm::vec3 y = glm::cross(normal, x);
    const glm::dmat2 inverse = glm::inverse(
        glm::dmat2({glm::dot(e1, x), glm::dot(e1, y)}, {glm::dot(e2, x), glm::dot(e2, y)}));
    Rest rest{e1, e2, normal, {inverse[0][0], inverse[0][1], inverse[1][0], inverse[1][1]}, {}};
    rest.axes = glsl::root_axes(e1, e2, normal, rest.inverse, 1.0f);
    return rest;
}

/// A triangle that is no sliver, its normal tilted a little.
Rest random_rest(Random& random) {
    for (;;) {
        const glm::vec3 e1 = in_cube(random);
        const glm::vec3 e2 = in_cube(random);
        const glm::vec3 face = glm::cross(e1, e2);
        if (glm::length(face) < 0.2f) continue;
        return rest_of(e1, e2, glm::normalize(glm::normalize(face) + 0.3f * in_cube(random)));
    }
}

float off_orthonormal(const glm::mat3& axes) {
    const glm::mat3 should = glm::transpose(axes) * axes;
    float worst = 0.0f;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            worst = std::max(worst, std::abs(should[i][k] - (i == k ? 1.0f : 0.0f)));
        }
    }
    return worst;
}

bool is_finite(const glm::mat3& axes) {
    return glsl::is_finite(axes[0]) && glsl::is_finite(axes[1]) && glsl::is_finite(axes[2]);
}

TEST(RootAxes, AreARotationThatFollowsARigidTriangle) {
    for (uint64_t sample = 0; sample < 5000; ++sample) {
        Random random(11, sample);
        const Rest rest = random_rest(random);
        ASSERT_LT(off_orthonormal(rest.axes), 3e-6f);
        ASSERT_GT(glm::determinant(rest.axes), 0.0f) << "motion takes the axes as a rotation";
        const glm::quat turn = glm::angleAxis(static_cast<float>(random.range(0, 6.28)),
                                              glm::vec3(random.direction()));
        const float scale = static_cast<float>(random.log_range(1e-3, 1e3));
        const glm::mat3 axes =
            glsl::root_axes(turn * rest.e1 * scale, turn * rest.e2 * scale,
                            turn * rest.normal * scale * scale, rest.inverse, 1.0f);
        for (int i = 0; i < 3; ++i) {
            // A handful of float operations on unit vectors, some amplified by narrow triangles.
            ASSERT_LT(glm::distance(axes[i], turn * rest.axes[i]), 3e-5f) << sample;
        }
    }
}

TEST(RootAxes, PreferNoEdge) {
    // The same sheared triangle, named from each of its corners, turns alike.
    for (uint64_t sample = 0; sample < 2000; ++sample) {
        Random random(12, sample);
        const Rest rest = random_rest(random);
        const glm::vec3 corners[] = {glm::vec3(0.0f), rest.e1, rest.e2};
        const glm::mat3 shear(glm::vec3(1, 0.3f, 0), glm::vec3(0.2f, 1.2f, 0.1f),
                              glm::vec3(0, -0.4f, 0.9f));
        const glm::vec3 normal = glm::inverse(glm::transpose(shear)) * rest.normal;
        glm::vec3 first{};
        for (int k = 0; k < 3; ++k) {
            const Rest same = rest_of(corners[(k + 1) % 3] - corners[k],
                                      corners[(k + 2) % 3] - corners[k], rest.normal);
            const glm::mat3 axes =
                glsl::root_axes(shear * same.e1, shear * same.e2, normal, same.inverse, 1.0f);
            if (k == 0) first = axes[0];
            ASSERT_LT(glm::distance(axes[0], first), 1e-4f) << sample;
        }
    }
}

TEST(RootAxes, AMirroredTriangleGetsMirroredAxes) {
    const glm::mat3 mirror(glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1));
    for (uint64_t sample = 0; sample < 2000; ++sample) {
        Random random(13, sample);
        const Rest rest = random_rest(random);
        const glm::mat3 axes = glsl::root_axes(mirror * rest.e1, mirror * rest.e2,
                                               mirror * rest.normal, rest.inverse, -1.0f);
        for (int i = 0; i < 3; ++i) {
            ASSERT_LT(glm::distance(axes[i], mirror * rest.axes[i]), 3e-5f) << sample;
        }
    }
}

TEST(RootAxes, AreOrthonormalWhateverTheTriangle) {
    const glm::vec3 values[] = {
        {0, 0, 0},           {1, 0, 0},     {0, 1, 0},          {0, 0, -1},    {1e-20f, 0, 0},
        {1e-30f, 1e-30f, 0}, {1e18f, 0, 1}, {-1e15f, 2e15f, 0}, {1e-7f, 1, 0}, {0, 1.0f, 1e-9f}};
    const glm::vec4 inverses[] = {{1, 0, 0, 1}, {0, 0, 0, 0}, {1e10f, -1e10f, 1e10f, 1e10f}};
    for (const glm::vec3& e1 : values) {
        for (const glm::vec3& e2 : values) {
            for (const glm::vec3& normal : values) {
                for (const glm::vec4& inverse : inverses) {
                    for (const float hand : {1.0f, -1.0f}) {
                        const glm::mat3 axes = glsl::root_axes(e1, e2, normal, inverse, hand);
                        ASSERT_TRUE(is_finite(axes));
                        ASSERT_LT(off_orthonormal(axes), 1e-5f);
                    }
                }
            }
        }
    }
}

TEST(RootAxes, ATriangleFallenIntoALineKeepsTheLinesTurn) {
    const Rest rest = rest_of({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const glm::quat turn = glm::angleAxis(0.7f, glm::vec3(0, 0, 1));
    const glm::mat3 axes =
        glsl::root_axes(turn * rest.e1, glm::vec3(0.0f), rest.normal, rest.inverse, 1.0f);
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT(glm::distance(axes[i], turn * rest.axes[i]), 1e-6f);
    }
}

TEST(MapNormal, StaysAcrossEveryTangent) {
    for (uint64_t sample = 0; sample < 2000; ++sample) {
        Random random(14, sample);
        const glm::mat4x3 m(in_cube(random), in_cube(random), in_cube(random), in_cube(random));
        const auto n = glm::vec3(random.direction());
        const glm::vec3 tangent = glsl::any_across(n);
        EXPECT_NEAR(glm::dot(tangent, n), 0.0f, 1e-6f);
        const glm::vec3 mapped = glsl::map_normal(m, n);
        EXPECT_NEAR(glm::dot(glm::mat3(m) * tangent, mapped), 0.0f, 5e-6f);
        // On its side: what pointed out of the surface still does.
        EXPECT_GE(glm::dot(glm::mat3(m) * n, mapped), -1e-6f);
    }
}

}  // namespace
}  // namespace vellus::hair
