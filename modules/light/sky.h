#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/asset/image.h"

namespace vellus::light {

/// The default outdoor light: a clear sky, its sun and a plain ground. Irradiances are luminances,
/// so that a white diffuse surface facing the sun shows radiance (sun + sky) / π, about 1.
struct Sky {
    /// Towards the sun; need not be unit. At or below the horizon it counts as just above.
    glm::dvec3 to_sun{0.45, 0.62, 0.64};
    /// Across the sun's beam.
    double sun_irradiance = 2.5;
    /// On a horizontal surface, without the sun.
    double sky_irradiance = 0.5;
    /// Linear reflectance, [0, 1].
    glm::dvec3 ground_albedo{0.42, 0.40, 0.37};
};

/// Exposure that shows people and landscape under this sky as bright as a photographer would: a
/// white surface that faces the sun is just beyond white, as skin, cloth and grass reflect far
/// less.
inline constexpr float kSkyExposure = 1.5f;

struct SunLight {
    glm::vec3 to_sun;
    /// Across the beam, linear RGB.
    glm::vec3 irradiance;
};

/// The sun that belongs to the sky: reddened by the air on its way (Rayleigh and haze, air mass by
/// Kasten and Young 1989), scaled to Sky::sun_irradiance.
SunLight sky_sun(const Sky& sky);

/// The sky without the sun's disc as an equirectangular image. Luminance is that of the CIE
/// standard clear sky, type 12 (Darula and Kittler 2002); colour that of light scattered once by
/// clean air (Rayleigh, λ⁻⁴): blue above, white at the horizon; below, the ground as sun and sky
/// light it.
asset::ImageF render_sky(const Sky& sky, uint32_t width, uint32_t height);

}  // namespace vellus::light
