#include "modules/hair/reference/kajiya_kay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/dielectric.h"

namespace vellus::hair::reference {

KajiyaKay kajiya_kay_parameters(const glsl::HairSurface& surface, int channel) {
    const double beta = std::max(static_cast<double>(surface.roughness) * surface.roughness,
                                 static_cast<double>(glsl::kHairMinBeta));
    const double f0 = fresnel_dielectric(1.0, 1.55);
    return {.diffuse = surface.base_color[channel] / (std::numbers::pi * std::numbers::pi),
            .specular = 2.0 * surface.specular * f0 /
                        (2.0 * std::numbers::pi * beta * std::sqrt(2.0 * std::numbers::pi)),
            .exponent = 1.0 / (beta * beta)};
}

double kajiya_kay(const KajiyaKay& parameters, double theta_i, double theta_r) {
    const double highlight = std::max(std::cos(theta_i + theta_r), 0.0);
    return parameters.diffuse * std::abs(std::cos(theta_i)) +
           parameters.specular * std::pow(highlight, parameters.exponent);
}

}  // namespace vellus::hair::reference
