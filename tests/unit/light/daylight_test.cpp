#include "modules/light/daylight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vellus::light {
namespace {

TEST(Daylight, NoonIsSouthAndAsHighAsLatitudeAndSeasonSay) {
    const Sky noon = sky_at(12.0);
    EXPECT_NEAR(noon.to_sun.x, 0.0, 1e-12);
    EXPECT_GT(noon.to_sun.z, 0.0);
    // 90 - 45 + 20 degrees.
    EXPECT_NEAR(std::asin(noon.to_sun.y) * 180.0 / std::acos(-1.0), 65.0, 1e-9);
    EXPECT_GT(sky_at(8.0).to_sun.x, 0.0) << "mornings in the east";
    EXPECT_LT(sky_at(17.0).to_sun.x, 0.0);
}

TEST(Daylight, TheSunRisesWhenTheSunriseEquationSays) {
    // cos H = -tan(latitude) tan(declination)
    const double hours =
        std::acos(-std::tan(20.0 * std::acos(-1.0) / 180.0)) * 12.0 / std::acos(-1.0);
    EXPECT_NEAR(sun_elevation_sine(12.0 - hours), 0.0, 1e-12);
    EXPECT_EQ(sky_at(12.0 - hours - 0.01).sun_irradiance, 0.0);
    EXPECT_GT(sky_at(12.0 - hours + 0.1).sun_irradiance, 0.0);
}

TEST(Daylight, LightGrowsUntilNoonWithoutAJump) {
    Sky before = sky_at(0.0);
    EXPECT_GT(before.sky_irradiance, 0.0) << "a night that is not black";
    for (int step = 1; step <= 720; ++step) {
        const Sky sky = sky_at(step / 60.0);
        EXPECT_GE(sky.sun_irradiance, before.sun_irradiance - 1e-12) << step;
        EXPECT_GE(sky.sky_irradiance, before.sky_irradiance - 1e-12) << step;
        EXPECT_LT(sky.sun_irradiance - before.sun_irradiance, 0.15) << step;
        EXPECT_NEAR(glm::length(sky.to_sun), 1.0, 1e-12);
        before = sky;
    }
}

}  // namespace
}  // namespace vellus::light
