#include "modules/hair/reference/fibre.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/dielectric.h"
#include "modules/hair/reference/quadrature.h"

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

Fibre karis_fibre(const glsl::HairSurface& surface, int channel) {
    const double r2 = static_cast<double>(surface.roughness) * surface.roughness;
    const double least = glsl::kHairMinBeta;
    const double tilt = std::asin(static_cast<double>(surface.shift));
    const double color = std::max(static_cast<double>(surface.base_color[channel]), 1e-37);
    return {.eta = 1.55,
            .absorption = -0.25 * std::log(std::min(color, 1.0)),
            .beta = {std::max(r2, least), std::max(0.5 * r2, least), std::max(2.0 * r2, least)},
            .azimuthal = {0.0, kKarisAzimuthalTt, kKarisAzimuthalTrt},
            .tilt = {-2.0 * tilt, tilt, 4.0 * tilt},
            .reflection = 2.0 * surface.specular};
}

double modified_index(double eta, double theta_d) {
    const double s = std::sin(theta_d);
    return std::sqrt(eta * eta - s * s) / std::max(std::abs(std::cos(theta_d)), 1e-300);
}

double exit_azimuth(int p, double modified, double h) {
    return 2.0 * p * std::asin(h / modified) - 2.0 * std::asin(h) + p * kPi;
}

double path_attenuation(const Fibre& fibre, int p, double theta_d, double h) {
    const double cos_d = std::abs(std::cos(theta_d));
    const double f = fresnel_dielectric(cos_d * std::sqrt(std::max(1.0 - h * h, 0.0)), fibre.eta);
    if (p == 0) return f * fibre.reflection;
    const double sin_t = std::sin(theta_d) / fibre.eta;
    const double cos_t = std::sqrt(1.0 - sin_t * sin_t);
    const double gamma = h / modified_index(fibre.eta, theta_d);
    const double chord = 2.0 * std::sqrt(1.0 - gamma * gamma) / cos_t;
    return (1.0 - f) * (1.0 - f) * std::pow(f, p - 1) * std::exp(-fibre.absorption * chord * p);
}

double lobe_attenuation(const Fibre& fibre, int p, double theta_d) {
    return integrate_gauss(0.0, 0.5 * kPi, 64, [&](double gamma) {
        return path_attenuation(fibre, p, theta_d, std::sin(gamma)) * std::cos(gamma);
    });
}

double wrapped_gaussian(double phi, double width) {
    const double turn = 2.0 * kPi;
    const double near = std::remainder(phi, turn);
    const int reach = 1 + static_cast<int>(std::ceil(9.0 * width / turn));
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        const double x = (near - turn * k) / width;
        sum += std::exp(-0.5 * x * x);
    }
    return sum / (width * std::sqrt(turn));
}

}  // namespace vellus::hair::reference
