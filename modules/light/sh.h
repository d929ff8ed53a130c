#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/asset/image.h"
#include "modules/light/light_glsl.h"

namespace vellus::light {

/// Radiance of an environment in the nine orthonormal real spherical harmonics with polar axis +Y,
/// in the order of shaders/light/sh.glsl: 1, x, y, z, xy, yz, 3y² - 1, xz, z² - x².
using ShRadiance = std::array<glm::dvec3, 9>;

/// Projects an equirectangular image (shaders/light/equirect.glsl says which way it faces) with the
/// exact solid angle of each row. Non-finite and negative channels count as the largest half and as
/// 0. Runs on all cores; the result does not depend on their number.
ShRadiance project_sh(const asset::ImageF& equirect);

/// The environment turned by `radians` about +Y, counter-clockwise seen from above.
ShRadiance rotate_about_y(const ShRadiance& radiance, double radians);

/// What shaders evaluate: coefficients of irradiance/π (cosine lobe: 1, 2/3, 1/4) times `scale`.
/// No window against ringing: the worst case, one sun in the dark, dips to -4 % of its peak, which
/// the shader cuts at 0; a window would blur every other map for it.
glsl::Sh9 irradiance_over_pi(const ShRadiance& radiance, double scale = 1.0);

}  // namespace vellus::light
