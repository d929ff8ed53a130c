#include "modules/hair/shadow/pcf_exponential.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/sampling.h"

namespace vellus::hair {
namespace {

using Map = std::array<std::array<float, 8>, 8>;

Map random_map(test::Random& random) {
    Map map{};
    for (auto& row : map) {
        for (float& value : row) value = static_cast<float>(random.unit());
    }
    return map;
}

/// textureGather of the 2×2 texels whose lower corner is (x, y).
glm::vec4 gather(const Map& map, int x, int y) {
    return {map[y + 1][x], map[y + 1][x + 1], map[y][x + 1], map[y][x]};
}

TEST(PcfExponential, IsTheExponentialOfTheDepthBehind) {
    for (uint64_t i = 0; i < 100'000; ++i) {
        test::Random random(1, i);
        const double receiver = random.range(0.0, 20.0);
        const double occluder = random.range(0.0, 20.0);
        const double falloff = random.log_range(1e-3, 1e3);
        const auto r = static_cast<float>(receiver);
        const auto o = static_cast<float>(occluder);
        const auto c = static_cast<float>(falloff);
        const double exact =
            std::exp(-static_cast<double>(c) * std::max(static_cast<double>(r) - o, 0.0));
        // The difference of two float depths is exact to 2⁻²⁴ of the result, the exponent to 2⁻²³
        // of itself.
        EXPECT_NEAR(glsl::exponential_transmittance(r, o, c), exact, 1e-6);
        EXPECT_EQ(glsl::exponential_transmittance(r, glm::vec4(o), c).z,
                  glsl::exponential_transmittance(r, o, c));
    }
}

TEST(PcfExponential, LitBeforeTheCasterDarkFarBehind) {
    EXPECT_EQ(glsl::exponential_transmittance(1.0f, 1.5f, 1e4f), 1.0f);
    EXPECT_EQ(glsl::exponential_transmittance(2.0f, 2.0f, 1e30f), 1.0f);
    EXPECT_EQ(glsl::exponential_transmittance(2.0f, 1.0f, 1e4f), 0.0f);
}

TEST(PcfExponential, GatherWeightsInterpolateLinearly) {
    test::Random random(2, 0);
    const Map map = random_map(random);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 uv(random.range(0.2, 0.8), random.range(0.2, 0.8));
        const glm::dvec2 position = glm::dvec2(uv) * 8.0 - 0.5;
        const int x = static_cast<int>(position.x);
        const int y = static_cast<int>(position.y);
        const glm::vec4 weights = glsl::pcf_gather_weights(glsl::pcf_fraction(uv, glm::vec2(8.0f)));
        const double fx = position.x - x;
        const double fy = position.y - y;
        const double exact = (map[y][x] * (1 - fx) + map[y][x + 1] * fx) * (1 - fy) +
                             (map[y + 1][x] * (1 - fx) + map[y + 1][x + 1] * fx) * fy;
        EXPECT_NEAR(glm::dot(weights, gather(map, x, y)), exact, 2e-6);
    }
}

TEST(PcfExponential, BoxFilterIsTheMeanOverThreeByThreeTexels) {
    test::Random random(3, 0);
    const Map map = random_map(random);
    for (int i = 0; i < 20; ++i) {
        const glm::vec2 uv(random.range(0.4, 0.6), random.range(0.4, 0.6));
        const glm::vec2 f = glsl::pcf_fraction(uv, glm::vec2(8.0f));
        const int x = static_cast<int>(uv.x * 8.0f - 0.5f);
        const int y = static_cast<int>(uv.y * 8.0f - 0.5f);
        const float filtered =
            glsl::pcf_box_filter(f, gather(map, x - 1, y - 1), gather(map, x + 1, y - 1),
                                 gather(map, x - 1, y + 1), gather(map, x + 1, y + 1));
        constexpr int kSteps = 600;
        double sum = 0.0;
        for (int a = 0; a < kSteps; ++a) {
            for (int b = 0; b < kSteps; ++b) {
                const double px = uv.x * 8.0 - 1.5 + 3.0 * (a + 0.5) / kSteps;
                const double py = uv.y * 8.0 - 1.5 + 3.0 * (b + 0.5) / kSteps;
                sum += map[static_cast<int>(py)][static_cast<int>(px)];
            }
        }
        // Brute force misplaces each of the texel edges by at most half a step.
        EXPECT_NEAR(filtered, sum / (kSteps * kSteps), 4.0 / kSteps);
    }
}

TEST(PcfExponential, AveragingTransmittancesLetsMoreThroughThanAveragingDepths) {
    // Jensen: the mean of e^(-x) is at least e^(-mean x).
    for (uint64_t i = 0; i < 1000; ++i) {
        test::Random random(4, i);
        const glm::vec4 depths(random.unit(), random.unit(), random.unit(), random.unit());
        const glm::vec4 weights = glsl::pcf_gather_weights({random.unit(), random.unit()});
        const float after = glm::dot(weights, glsl::exponential_transmittance(1.0f, depths, 30.0f));
        const float before =
            glsl::exponential_transmittance(1.0f, glm::dot(weights, depths), 30.0f);
        EXPECT_GE(after, before - 1e-6f);
    }
}

TEST(PcfExponential, OpaqueRampIsLitWithinTheBiasAndDarkBeyondTwo) {
    const glm::vec4 depths(1.0f, 0.99f, 0.985f, 0.9f);
    const glm::vec4 light = glsl::opaque_visibility(1.0f, depths, 0.01f);
    EXPECT_EQ(light.x, 1.0f);
    EXPECT_NEAR(light.y, 1.0f, 1e-4f);
    EXPECT_NEAR(light.z, 0.5f, 1e-4f);
    EXPECT_EQ(light.w, 0.0f);
}

TEST(PcfExponential, APlaneDoesNotShadowItself) {
    // A tilted plane z(x, y) under a light along -z, its map sampled at texel centres: the
    // receiver, moved by shadow_normal_offset, is nowhere behind one of the four texels it is
    // compared with.
    constexpr double kTexel = 0.01;
    for (uint64_t i = 0; i < 20000; ++i) {
        test::Random random(5, i);
        const double slope = random.range(0.0, 85.0) * std::numbers::pi / 180.0;
        const double heading = random.range(0.0, 2.0 * std::numbers::pi);
        const glm::dvec3 normal(std::sin(slope) * std::cos(heading),
                                std::sin(slope) * std::sin(heading), std::cos(slope));
        const auto depth_at = [&](double x, double y) {
            return (normal.x * x + normal.y * y) / normal.z;
        };
        const glm::dvec3 point(random.unit(), random.unit(), 0.0);
        const glm::dvec3 moved = glm::dvec3(point.x, point.y, -depth_at(point.x, point.y)) +
                                 glm::dvec3(glsl::shadow_normal_offset(normal, {0.0f, 0.0f, 1.0f},
                                                                       static_cast<float>(kTexel)));
        const double x = std::floor(moved.x / kTexel - 0.5);
        const double y = std::floor(moved.y / kTexel - 0.5);
        for (int corner = 0; corner < 4; ++corner) {
            const double occluder =
                depth_at((x + 0.5 + corner % 2) * kTexel, (y + 0.5 + (corner >> 1)) * kTexel);
            EXPECT_LE(-moved.z, occluder + 1e-6);
        }
    }
}

}  // namespace
}  // namespace vellus::hair
