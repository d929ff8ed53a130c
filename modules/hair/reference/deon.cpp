#include "modules/hair/reference/deon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/longitudinal.h"
#include "modules/hair/reference/quadrature.h"

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;

/// Nodes in γi for a detector of this width: exit azimuths move by at most 2p/η' + 2 per radian.
int offset_nodes(const Fibre& fibre, int p) {
    return 48 + static_cast<int>(std::ceil(16.0 * p / std::max(fibre.azimuthal[p], 0.01)));
}

}  // namespace

double deon_longitudinal(const Fibre& fibre, int p, double theta_i, double theta_r) {
    return longitudinal_deon(fibre.beta[p] * fibre.beta[p], theta_i, theta_r - fibre.tilt[p]);
}

double deon_azimuthal(const Fibre& fibre, int p, double theta_d, double phi) {
    if (p == 0) {
        const double cos_half = std::abs(std::cos(0.5 * phi));
        return 0.25 * cos_half *
               path_attenuation(fibre, 0, theta_d, std::sqrt(1.0 - cos_half * cos_half));
    }
    const double modified = modified_index(fibre.eta, theta_d);
    return 0.5 * integrate_gauss(-0.5 * kPi, 0.5 * kPi, offset_nodes(fibre, p), [&](double gamma) {
               const double h = std::sin(gamma);
               return path_attenuation(fibre, p, theta_d, h) * std::cos(gamma) *
                      wrapped_gaussian(phi - exit_azimuth(p, modified, h), fibre.azimuthal[p]);
           });
}

std::vector<double> deon_azimuthal_series(const Fibre& fibre, int p, double theta_d, int count) {
    std::vector<double> series(count, 0.0);
    const double modified = modified_index(fibre.eta, theta_d);
    const GaussRule& rule = gauss_rule(64 + 2 * p * count);
    // Even in h: half the interval, twice the weight.
    for (size_t i = 0; i < rule.node.size(); ++i) {
        const double gamma = 0.25 * kPi * (1.0 + rule.node[i]);
        const double h = std::sin(gamma);
        const double weight = 0.25 * kPi * rule.weight[i] * std::cos(gamma) / (2.0 * kPi) *
                              path_attenuation(fibre, p, theta_d, h);
        const double azimuth = exit_azimuth(p, modified, h);
        for (int k = 0; k < count; ++k) series[k] += weight * std::cos(k * azimuth);
    }
    const double b = fibre.azimuthal[p];
    for (int k = 0; k < count; ++k) series[k] *= std::exp(-0.5 * k * k * b * b);
    return series;
}

double cosine_sum(const std::vector<double>& series, double phi) {
    double sum = series.empty() ? 0.0 : series[0];
    for (size_t k = 1; k < series.size(); ++k) {
        sum += 2.0 * series[k] * std::cos(static_cast<double>(k) * phi);
    }
    return sum;
}

double deon(const Fibre& fibre, double theta_i, double theta_r, double phi) {
    const double theta_d = 0.5 * (theta_r - theta_i);
    double sum = 0.0;
    for (int p = 0; p < 3; ++p) {
        sum +=
            deon_longitudinal(fibre, p, theta_i, theta_r) * deon_azimuthal(fibre, p, theta_d, phi);
    }
    return sum;
}

double deon_furnace(const Fibre& fibre, double theta_r) {
    double sum = 0.0;
    for (int p = 0; p < 3; ++p) {
        const double peak = std::clamp(fibre.tilt[p] - theta_r, -0.5 * kPi, 0.5 * kPi);
        const double reach = 14.0 * fibre.beta[p];
        const double low = std::max(peak - reach, -0.5 * kPi);
        const double high = std::min(peak + reach, 0.5 * kPi);
        sum += integrate_gauss(low, high, 192, [&](double theta_i) {
            return deon_longitudinal(fibre, p, theta_i, theta_r) *
                   lobe_attenuation(fibre, p, 0.5 * (theta_r - theta_i)) * std::cos(theta_i);
        });
    }
    return sum;
}

}  // namespace vellus::hair::reference
