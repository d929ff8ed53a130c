#include "modules/light/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/light/sh.h"

namespace vellus::light {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance(const glm::dvec3& c) {
    return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 texel(const asset::ImageF& image, uint32_t column, uint32_t row) {
    const float* t = image.rgba.data() + (size_t{row} * image.width + column) * 4;
    return {t[0], t[1], t[2]};
}

/// Luminance that falls on the ground from the image's upper half.
double irradiance_from_above(const asset::ImageF& image) {
    double sum = 0.0;
    for (uint32_t row = 0; row < image.height / 2; ++row) {
        const double top = std::cos(kPi * row / image.height);
        const double bottom = std::cos(kPi * (row + 1.0) / image.height);
        for (uint32_t column = 0; column < image.width; ++column) {
            sum += luminance(texel(image, column, row)) * kPi / image.width *
                   (top * top - bottom * bottom);
        }
    }
    return sum;
}

TEST(Sky, TheSkysIrradianceIsWhatWasAskedFor) {
    for (const double height : {0.1, 0.5, 1.0}) {
        const Sky sky{.to_sun = {0.3, height, 0.2}, .sky_irradiance = 0.7};
        // Below 2 % of sine elevation haze mixes in ground, whose cosine weight is small.
        EXPECT_NEAR(irradiance_from_above(render_sky(sky, 256, 128)), 0.7, 0.007);
    }
}

TEST(Sky, SunIsWarmAndFiveTimesTheSky) {
    const Sky sky;
    const SunLight sun = sky_sun(sky);
    EXPECT_NEAR(luminance(sun.irradiance) / sky.sky_irradiance, 5.0, 1e-3);
    EXPECT_GT(sun.irradiance.x, sun.irradiance.y);
    EXPECT_GT(sun.irradiance.y, sun.irradiance.z);
    EXPECT_NEAR(glm::length(sun.to_sun), 1.0f, 1e-6f);
    const Sky evening{.to_sun = {0.0, 0.1, 1.0}};
    EXPECT_GT(sky_sun(evening).irradiance.x / sky_sun(evening).irradiance.z,
              1.5f * sun.irradiance.x / sun.irradiance.z);
}

TEST(Sky, AWhiteSurfaceInTheSunIsAboutOne) {
    const Sky sky;
    const auto sh = irradiance_over_pi(project_sh(render_sky(sky, 256, 128)));
    const SunLight sun = sky_sun(sky);
    const double radiance = luminance(glm::dvec3(sun.irradiance)) / kPi +
                            luminance(glm::dvec3(glsl::sh_irradiance_over_pi(sh, sun.to_sun)));
    EXPECT_GT(radiance, 0.8);
    EXPECT_LT(radiance, 1.2);
}

TEST(Sky, ZenithIsBlueHorizonPalerAndTheSunsSideBrighter) {
    const Sky sky{.to_sun = {0.0, 0.5, 1.0}};
    const auto image = render_sky(sky, 256, 128);
    const glm::dvec3 zenith = texel(image, 0, 0);
    const glm::dvec3 horizon = texel(image, 0, 61);
    EXPECT_GT(zenith.z / zenith.x, 1.8);
    EXPECT_LT(horizon.z / horizon.x, 0.7 * zenith.z / zenith.x);
    EXPECT_GT(luminance(texel(image, 128, 40)), 2.0 * luminance(texel(image, 0, 40)));
}

TEST(Sky, StaysFiniteWhereverTheSunIs) {
    for (const glm::dvec3 to_sun : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0),
                                    glm::dvec3(0, 0, 0), glm::dvec3(1e-9, 2e-9, 0)}) {
        const Sky sky{.to_sun = to_sun};
        for (const float value : render_sky(sky, 32, 16).rgba) {
            ASSERT_TRUE(std::isfinite(value));
            ASSERT_GE(value, 0.0f);
        }
        ASSERT_TRUE(std::isfinite(sky_sun(sky).irradiance.x));
        ASSERT_GT(sky_sun(sky).irradiance.x, 0.0f);
    }
}

}  // namespace
}  // namespace vellus::light
