#include "modules/hair/reference/tracer/environment_light.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/unit/tracer/scenes.h"

namespace vellus::hair::tracer {
namespace {

constexpr double kPi = std::numbers::pi;

/// ∫ over the sphere by the midpoint rule in height and longitude.
glm::dvec3 integrate(const std::function<glm::dvec3(const glm::dvec3&)>& f) {
    constexpr int kRows = 800;
    constexpr int kColumns = 1600;
    glm::dvec3 sum(0.0);
    for (int row = 0; row < kRows; ++row) {
        const double y = 2.0 * (row + 0.5) / kRows - 1.0;
        const double across = std::sqrt(1.0 - y * y);
        for (int column = 0; column < kColumns; ++column) {
            const double turn = 2.0 * kPi * (column + 0.5) / kColumns;
            sum += f({across * std::sin(turn), y, across * std::cos(turn)});
        }
    }
    return sum * (4.0 * kPi / (double{kRows} * kColumns));
}

TEST(EnvironmentLight, DensityIntegratesToOne) {
    const EnvironmentLight light(test::uneven_environment());
    // The rule does not end at texel borders: off by up to a step's share of the border texels.
    EXPECT_NEAR(integrate([&](const glm::dvec3& d) { return glm::dvec3(light.pdf(d)); }).x, 1.0,
                0.01);
}

TEST(EnvironmentLight, SamplesWeighedByTheirDensityGiveTheIntegral) {
    const EnvironmentLight light(test::uneven_environment());
    const glm::dvec3 exact =
        integrate([&](const glm::dvec3& d) { return light.radiance(d) * std::max(d.y, 0.0); });
    const auto sampled = test::estimate(200'000, [&](int i) {
        Random random(3, 0, static_cast<uint32_t>(i));
        const auto s = light.sample(random.unit2());
        return light.radiance(s.direction) * std::max(s.direction.y, 0.0) / s.pdf;
    });
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sampled.mean[c], exact[c], 4.5 * sampled.error[c] + 2e-3 * exact[c]);
    }
}

TEST(EnvironmentLight, DensityOfASampleIsTheDensityThere) {
    const EnvironmentLight light(test::uneven_environment());
    int differ = 0;
    for (uint32_t i = 0; i < 10'000; ++i) {
        Random random(4, 0, i);
        const auto s = light.sample(random.unit2());
        ASSERT_NEAR(glm::length(s.direction), 1.0, 1e-9);
        // Looked up in float, a sample at a texel's border may fall beside it.
        if (std::abs(light.pdf(s.direction) / s.pdf - 1.0) > 1e-6) ++differ;
    }
    EXPECT_LE(differ, 5);
}

TEST(EnvironmentLight, NothingBrightIsImpossible) {
    const EnvironmentLight light(test::uneven_environment());
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 d = vellus::test::Random(5, i).direction();
        if (light.radiance(d).x > 0.0) {
            ASSERT_GT(light.pdf(d), 0.0);
        }
    }
}

TEST(EnvironmentLight, TurnsAndScalesAsTheSkyShader) {
    Environment environment = test::uneven_environment();
    environment.rotation = 0.0;
    const EnvironmentLight still(environment);
    environment.rotation = 0.7;
    environment.intensity = 3.0;
    const EnvironmentLight turned(environment);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 d = vellus::test::Random(6, i).direction();
        // Counter-clockwise from above: what was at +Z moves towards +X.
        const glm::dvec3 r(std::cos(0.7) * d.x + std::sin(0.7) * d.z, d.y,
                           -std::sin(0.7) * d.x + std::cos(0.7) * d.z);
        EXPECT_NEAR(turned.radiance(r).x, 3.0 * still.radiance(d).x, 1e-4);
    }
}

TEST(EnvironmentLight, BlackHasNoLight) {
    EXPECT_TRUE(EnvironmentLight().black());
    const EnvironmentLight black(test::constant_environment(glm::vec3(0.0f)));
    EXPECT_TRUE(black.black());
    EXPECT_EQ(black.pdf({0, 1, 0}), 0.0);
    EXPECT_EQ(black.radiance({0, 1, 0}), glm::dvec3(0.0));
}

}  // namespace
}  // namespace vellus::hair::tracer
