#include "modules/hair/reference/dual_scattering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/deon.h"
#include "modules/hair/reference/quadrature.h"

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;

/// |φ|/π seen through a Gaussian detector: ½ - 4/π² Σ over odd k of e^(-k²b²/2) cos kφ / k².
double forward_weight(double phi, double width) {
    const double near = std::abs(std::remainder(phi, 2.0 * kPi));
    if (width <= 0.0) return near / kPi;
    double sum = 0.5;
    for (int k = 1; k * width < 9.0; k += 2) {
        const double x = k * width;
        sum -= 4.0 / (kPi * kPi) * std::exp(-0.5 * x * x) * std::cos(k * near) / (k * k);
    }
    return sum;
}

/// ∫ N_p |φ|/π dφ.
double forward_share(const Fibre& fibre, int p, double theta_d) {
    const double modified = modified_index(fibre.eta, theta_d);
    return integrate_gauss(0.0, 0.5 * kPi, 96, [&](double gamma) {
        const double h = std::sin(gamma);
        return path_attenuation(fibre, p, theta_d, h) * std::cos(gamma) *
               forward_weight(exit_azimuth(p, modified, h), fibre.azimuthal[p]);
    });
}

struct LobeShares {
    double forward = 0.0;
    double backward = 0.0;
};

LobeShares lobe_shares(const Fibre& fibre, int p, double theta_i) {
    const double peak = std::clamp(fibre.tilt[p] - theta_i, -0.5 * kPi, 0.5 * kPi);
    const double reach = 12.0 * fibre.beta[p];
    const double low = std::max(peak - reach, -0.5 * kPi);
    const double high = std::min(peak + reach, 0.5 * kPi);
    LobeShares shares;
    const GaussRule& rule = gauss_rule(96);
    for (size_t i = 0; i < rule.node.size(); ++i) {
        const double theta_o = low + 0.5 * (high - low) * (1.0 + rule.node[i]);
        const double theta_d = 0.5 * (theta_o - theta_i);
        const double weight = 0.5 * (high - low) * rule.weight[i] * std::cos(theta_o) *
                              deon_longitudinal(fibre, p, theta_i, theta_o);
        const double forward = forward_share(fibre, p, theta_d);
        shares.forward += weight * forward;
        shares.backward += weight * (lobe_attenuation(fibre, p, theta_d) - forward);
    }
    return shares;
}

}  // namespace

DualAverages dual_averages(const Fibre& fibre, double theta_i) {
    DualAverages a;
    for (int p = 0; p < 3; ++p) {
        const LobeShares shares = lobe_shares(fibre, p, theta_i);
        a.forward += shares.forward;
        a.backward += shares.backward;
        a.forward_tilt += shares.forward * fibre.tilt[p];
        a.backward_tilt += shares.backward * fibre.tilt[p];
        a.forward_variance += shares.forward * fibre.beta[p] * fibre.beta[p];
        a.backward_variance += shares.backward * fibre.beta[p] * fibre.beta[p];
    }
    const double f = std::max(a.forward, 1e-300);
    const double b = std::max(a.backward, 1e-300);
    a.forward_tilt /= f;
    a.forward_variance /= f;
    a.backward_tilt /= b;
    a.backward_variance /= b;
    return a;
}

double half_space_reflectance(double forward, double backward) {
    const double f = forward;
    const double b = backward;
    const double root = (1.0 - b - f) * (1.0 - b + f) * (1.0 + b - f) * (1.0 + b + f);
    return 2.0 * b / (1.0 + b * b - f * f + std::sqrt(std::max(root, 0.0)));
}

double backscatter_all_orders(double forward, double backward) {
    return half_space_reflectance(forward, backward) - backward;
}

double backscatter_one(double forward, double backward) {
    const double f2 = forward * forward;
    return backward * f2 / (1.0 - f2);
}

double backscatter_three(double forward, double backward) {
    const double f2 = forward * forward;
    const double through = 1.0 - f2;
    return backward * backward * backward * f2 / (through * through * through);
}

double backscatter_tilt(const DualAverages& a) {
    const double f2 = a.forward * a.forward;
    const double b2 = a.backward * a.backward;
    const double through = 1.0 - f2;
    return a.backward_tilt * (1.0 - 2.0 * b2 / (through * through)) +
           a.forward_tilt * (2.0 * through * through + 4.0 * f2 * b2) /
               (through * through * through);
}

double backscatter_deviation(const DualAverages& a, double density) {
    const double b = a.backward;
    const double b3 = b * b * b;
    const double one = std::sqrt(2.0 * a.forward_variance + a.backward_variance);
    const double three = std::sqrt(2.0 * a.forward_variance + 3.0 * a.backward_variance);
    const double forward = std::sqrt(a.forward_variance);
    const double backward = std::sqrt(a.backward_variance);
    return (1.0 + density * a.forward * a.forward) * (b * one + b3 * three) /
           (b + b3 * (2.0 * forward + 3.0 * backward));
}

}  // namespace vellus::hair::reference
