#include "modules/light/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/platform/jobs.h"

namespace vellus::light {

namespace {

const glm::dvec3 kLuminance(0.2126, 0.7152, 0.0722);
/// (550 nm / λ)⁴ for red, green, blue at 610, 550, 465 nm.
const glm::dvec3 kRayleigh(0.661, 1.0, 1.957);
/// Vertical optical depth at 550 nm.
constexpr double kRayleighDepth = 0.097;
/// Sine of the elevation below which haze hides how much longer the path through clean air gets.
constexpr double kHaze = 0.06;
/// Width of the haze that joins sky and ground, as a sine of elevation.
constexpr double kHorizonHaze = 0.02;

glm::dvec3 sun_direction(const Sky& sky) {
    const double length = glm::length(sky.to_sun);
    const glm::dvec3 d = length > 0.0 ? sky.to_sun / length : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::dvec3(d.x, std::max(d.y, 0.02), d.z));
}

glm::dvec3 sun_irradiance(const Sky& sky) {
    const double elevation = std::asin(sun_direction(sky).y) * 180.0 / std::numbers::pi;
    const double air_mass =
        1.0 / (sun_direction(sky).y + 0.50572 * std::pow(elevation + 6.07995, -1.6364));
    const glm::dvec3 haze(0.087, 0.1, 0.124);  // aerosol 0.1 at 550 nm, Ångström exponent 1.3
    const glm::dvec3 color = glm::exp(-(kRayleighDepth * kRayleigh + haze) * air_mass);
    return color * (sky.sun_irradiance / glm::dot(color, kLuminance));
}

/// Radiance above the horizon, not yet scaled.
glm::dvec3 clear_sky(const glm::dvec3& direction, const glm::dvec3& to_sun) {
    const double cos_zenith = std::max(direction.y, 1.0e-3);
    const double gradation = 1.0 - std::exp(-0.32 / cos_zenith);
    // What a clean atmosphere scatters once towards the ground.
    const glm::dvec3 scattered =
        1.0 - glm::exp(-kRayleighDepth / std::max(cos_zenith, kHaze) * kRayleigh);
    const double cos_sun = std::clamp(glm::dot(direction, to_sun), -1.0, 1.0);
    const double angle = std::acos(cos_sun);
    const double indicatrix = 1.0 +
                              10.0 * (std::exp(-3.0 * angle) - std::exp(-1.5 * std::numbers::pi)) +
                              0.45 * cos_sun * cos_sun;
    return scattered * (gradation * indicatrix / glm::dot(scattered, kLuminance));
}

/// Irradiance of clear_sky on the ground; midpoint rule, good to 0.1 %.
glm::dvec3 sky_irradiance_on_ground(const glm::dvec3& to_sun) {
    constexpr int kRings = 64;
    constexpr int kSectors = 128;
    glm::dvec3 sum(0.0);
    for (int ring = 0; ring < kRings; ++ring) {
        // Equal steps in sin² of the zenith angle carry equal shares of the cosine-weighted
        // hemisphere.
        const double across = std::sqrt((ring + 0.5) / kRings);
        for (int sector = 0; sector < kSectors; ++sector) {
            const double azimuth = (sector + 0.5) / kSectors * 2.0 * std::numbers::pi;
            const glm::dvec3 d(across * std::sin(azimuth), std::sqrt(1.0 - across * across),
                               across * std::cos(azimuth));
            sum += clear_sky(d, to_sun);
        }
    }
    return sum * (std::numbers::pi / (kRings * kSectors));
}

}  // namespace

SunLight sky_sun(const Sky& sky) {
    return {sun_direction(sky), sun_irradiance(sky)};
}

asset::ImageF render_sky(const Sky& sky, uint32_t width, uint32_t height) {
    const glm::dvec3 to_sun = sun_direction(sky);
    const glm::dvec3 unscaled = sky_irradiance_on_ground(to_sun);
    const double scale = sky.sky_irradiance / glm::dot(unscaled, kLuminance);
    const glm::dvec3 ground = sky.ground_albedo * std::numbers::inv_pi *
                              (unscaled * scale + sun_irradiance(sky) * to_sun.y);
    asset::ImageF image;
    image.width = width;
    image.height = height;
    image.rgba.assign(size_t{width} * height * 4, 1.0f);
    parallel_ranges(height, 8, [&](size_t first, size_t last) {
        for (size_t row = first; row < last; ++row) {
            const double latitude = (0.5 - (row + 0.5) / height) * std::numbers::pi;
            const double above =
                std::clamp(0.5 + 0.5 * std::sin(latitude) / kHorizonHaze, 0.0, 1.0);
            float* texel = image.rgba.data() + row * width * 4;
            for (uint32_t column = 0; column < width; ++column, texel += 4) {
                const double longitude = (0.5 - (column + 0.5) / width) * 2.0 * std::numbers::pi;
                const double across = std::cos(latitude);
                const glm::dvec3 d(across * std::sin(longitude), std::sin(latitude),
                                   across * std::cos(longitude));
                const glm::dvec3 radiance = glm::mix(ground, clear_sky(d, to_sun) * scale, above);
                for (int i = 0; i < 3; ++i) texel[i] = static_cast<float>(radiance[i]);
            }
        }
    });
    return image;
}

}  // namespace vellus::light
