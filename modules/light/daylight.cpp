#include "modules/light/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vellus::light {

namespace {

constexpr double kLatitude = 45.0 * std::numbers::pi / 180.0;
constexpr double kDeclination = 20.0 * std::numbers::pi / 180.0;
/// Broadband extinction of the beam by a clear atmosphere, per air mass.
constexpr double kExtinction = 0.21;
constexpr double kNightSky = 0.012;

glm::dvec3 sun_at(double hour) {
    const double angle = (hour - 12.0) / 12.0 * std::numbers::pi;
    const double east = -std::cos(kDeclination) * std::sin(angle);
    const double up = std::sin(kLatitude) * std::sin(kDeclination) +
                      std::cos(kLatitude) * std::cos(kDeclination) * std::cos(angle);
    const double south = std::sin(kLatitude) * std::cos(kDeclination) * std::cos(angle) -
                         std::cos(kLatitude) * std::sin(kDeclination);
    return {east, up, south};
}

/// Relative optical path, 1 at the zenith; Kasten and Young 1989.
double air_mass(double sine) {
    const double degrees = std::asin(std::clamp(sine, 0.0, 1.0)) * 180.0 / std::numbers::pi;
    return 1.0 / (std::max(sine, 0.0) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
}

}  // namespace

double sun_elevation_sine(double hour) {
    return sun_at(hour).y;
}

Sky sky_at(double hour) {
    const Sky usual;
    const double usual_sine = glm::normalize(usual.to_sun).y;
    Sky sky;
    sky.to_sun = sun_at(hour);
    const double sine = sky.to_sun.y;
    const double through = std::exp(-kExtinction * (air_mass(sine) - air_mass(usual_sine)));
    // The disc takes about two degrees' worth of haze to disappear.
    const double above = std::clamp(sine / 0.04, 0.0, 1.0);
    sky.sun_irradiance = usual.sun_irradiance * through * above;
    const double twilight = std::clamp((sine + 0.12) / (usual_sine + 0.12), 0.0, 1.2);
    sky.sky_irradiance = kNightSky + (usual.sky_irradiance - kNightSky) * twilight;
    return sky;
}

}  // namespace vellus::light
