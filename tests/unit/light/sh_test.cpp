#include "modules/light/sh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/sampling.h"

namespace vellus::light {
namespace {

constexpr double kPi = std::numbers::pi;

template <class F>
asset::ImageF make_image(uint32_t width, uint32_t height, const F& radiance) {
    asset::ImageF image;
    image.width = width;
    image.height = height;
    for (uint32_t row = 0; row < height; ++row) {
        for (uint32_t column = 0; column < width; ++column) {
            const glm::vec3 d =
                glsl::equirect_direction({(column + 0.5f) / width, (row + 0.5f) / height});
            const glm::vec3 value = radiance(glm::dvec3(d));
            image.rgba.insert(image.rgba.end(), {value.x, value.y, value.z, 1.0f});
        }
    }
    return image;
}

glm::dvec3 irradiance(const asset::ImageF& image, const glm::dvec3& normal) {
    glm::dvec3 sum(0.0);
    for (uint32_t row = 0; row < image.height; ++row) {
        const double solid_angle =
            2.0 * kPi / image.width *
            (std::cos(kPi * row / image.height) - std::cos(kPi * (row + 1.0) / image.height));
        for (uint32_t column = 0; column < image.width; ++column) {
            const glm::dvec3 d = glsl::equirect_direction(
                {(column + 0.5f) / image.width, (row + 0.5f) / image.height});
            const float* texel = image.rgba.data() + (size_t{row} * image.width + column) * 4;
            sum += glm::dvec3(texel[0], texel[1], texel[2]) *
                   (std::max(glm::dot(d, normal), 0.0) * solid_angle);
        }
    }
    return sum;
}

/// Every function of order 3 and nothing above, so that the coefficients hold all of it.
glm::vec3 smooth(const glm::dvec3& d) {
    return {1.0 + 0.5 * d.x + 0.4 * d.x * d.y, 0.8 + 0.3 * d.y * d.z + 0.2 * d.x * d.z,
            0.6 + 0.2 * d.z + 0.1 * d.y + 0.3 * d.x * d.x + 0.2 * d.y * d.y};
}

TEST(Sh, ConstantWhiteIsOne) {
    const auto sh = irradiance_over_pi(
        project_sh(make_image(64, 32, [](const auto&) { return glm::vec3(1.0f); })));
    for (uint64_t i = 0; i < 100; ++i) {
        const glm::vec3 value = glsl::sh_irradiance_over_pi(sh, test::Random(1, i).direction());
        // Midpoint rule in latitude of 32 rows in the order-2 term: 2e-3.
        EXPECT_NEAR(value.x, 1.0f, 2e-3f);
        EXPECT_NEAR(value.z, 1.0f, 2e-3f);
    }
}

TEST(Sh, IsTheIrradianceOfASmoothEnvironment) {
    const auto image = make_image(256, 128, smooth);
    const auto sh = irradiance_over_pi(project_sh(image));
    for (uint64_t i = 0; i < 40; ++i) {
        const glm::dvec3 n = test::Random(2, i).direction();
        const glm::dvec3 exact = irradiance(image, n) / kPi;
        const glm::vec3 value = glsl::sh_irradiance_over_pi(sh, n);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], exact[c], 5e-4);
    }
}

TEST(Sh, TurningTheCoefficientsTurnsTheEnvironment) {
    const double angle = 0.7;
    const auto turned = [&](const glm::dvec3& d) {
        // The radiance seen towards d after the turn is the one from where d was before.
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        return smooth({c * d.x - s * d.z, d.y, s * d.x + c * d.z});
    };
    const auto expected = irradiance_over_pi(project_sh(make_image(256, 128, turned)));
    const auto value =
        irradiance_over_pi(rotate_about_y(project_sh(make_image(256, 128, smooth)), angle));
    for (int i = 0; i < 9; ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value.c[i][c], expected.c[i][c], 1e-5) << i;
    }
}

TEST(Sh, APositiveTurnIsCounterClockwiseFromAbove) {
    const auto from_x = project_sh(
        make_image(64, 32, [](const glm::dvec3& d) { return glm::vec3(std::max(d.x, 0.0)); }));
    const auto sh = irradiance_over_pi(rotate_about_y(from_x, kPi / 2.0));
    EXPECT_GT(glsl::sh_irradiance_over_pi(sh, {0, 0, -1}).x,
              5.0f * glsl::sh_irradiance_over_pi(sh, {0, 0, 1}).x);
}

TEST(Sh, SumsWhatIsNotANumberAsBlackAndInfinityAsTheLargestHalf) {
    auto image = make_image(16, 8, [](const auto&) { return glm::vec3(0.0f); });
    image.rgba[0] = std::numeric_limits<float>::quiet_NaN();
    image.rgba[4] = -5.0f;
    EXPECT_EQ(project_sh(image)[0].x, 0.0);
    image.rgba[8] = std::numeric_limits<float>::infinity();
    const double solid_angle = 2.0 * kPi / 16.0 * (1.0 - std::cos(kPi / 8.0));
    EXPECT_NEAR(project_sh(image)[0].x, 65504.0 * solid_angle * 0.28209479177387814, 1e-6);
    EXPECT_EQ(project_sh({})[0], glm::dvec3(0.0));
}

TEST(Sh, ALoneSunRingsByFourPercentAndIsCutAtZero) {
    ShRadiance sun{};
    const double y0[9] = {
        0.28209479177387814, 0, 0.4886025119029199, 0, 0, 0, 2.0 * 0.3153915652525201, 0, 0};
    for (int i = 0; i < 9; ++i) sun[i] = glm::dvec3(1e6 * y0[i]);
    const auto sh = irradiance_over_pi(sun);
    double least = 0.0;
    double most = 0.0;
    for (int i = -1000; i <= 1000; ++i) {
        const double c = i / 1000.0;
        const glm::vec3 n(std::sqrt(1.0 - c * c), c, 0.0);
        const double raw = sh.c[0].x + sh.c[2].x * n.y + sh.c[6].x * (2.0 * n.y * n.y - n.x * n.x);
        least = std::min(least, raw);
        most = std::max(most, raw);
        EXPECT_NEAR(glsl::sh_irradiance_over_pi(sh, n).x, std::max(raw, 0.0), 1.0);
    }
    EXPECT_NEAR(least / most, -0.037, 0.002);
}

TEST(Equirect, UvAndDirectionAreInverse) {
    for (uint64_t i = 0; i < 10000; ++i) {
        const glm::dvec3 d = test::Random(3, i).direction();
        const glm::dvec3 back = glsl::equirect_direction(glsl::equirect_uv(glm::vec3(d)));
        EXPECT_LT(glm::length(back - d), 2e-6);
    }
    EXPECT_EQ(glsl::equirect_uv({0, 0, 1}), glm::vec2(0.5f, 0.5f));
    EXPECT_NEAR(glsl::equirect_uv({1, 0, 0}).x, 0.25f, 1e-6f);
    EXPECT_NEAR(glsl::equirect_uv({0, 1, 0}).y, 0.0f, 1e-6f);
}

}  // namespace
}  // namespace vellus::light
