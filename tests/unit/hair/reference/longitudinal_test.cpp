#include "modules/hair/reference/longitudinal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vellus::hair::reference {
namespace {

/// Midpoint rule over the inclination; the integrand vanishes smoothly at both ends.
template <class F>
double integrate(double low, double high, int steps, const F& f) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += f(low + (high - low) * (i + 0.5) / steps);
    return sum * (high - low) / steps;
}

TEST(Longitudinal, BesselIsItsIntegral) {
    // e^-x I0(x) = 1/π ∫ e^(x (cos t - 1)) dt over [0, π]; the rule is spectrally accurate.
    for (const double x : {0.0, 1e-6, 0.5, 3.0, 12.0, 39.9, 40.1, 200.0, 1e4}) {
        const double exact =
            integrate(0.0, std::numbers::pi, 4000,
                      [&](double t) { return std::exp(x * (std::cos(t) - 1.0)); }) /
            std::numbers::pi;
        EXPECT_NEAR(bessel_i0e(x) / exact, 1.0, 1e-12) << "x = " << x;
    }
}

TEST(Longitudinal, DeonIntegratesToOneAtAnyRoughness) {
    for (const double v : {1e-6, 1e-4, 0.0025, 0.0225, 0.09, 0.5, 2.0}) {
        for (const double degrees : {-90.0, -85.0, -40.0, 0.0, 10.0, 60.0, 89.0, 90.0}) {
            const double theta_r = degrees * std::numbers::pi / 180.0;
            // The lobe is a few √v wide around -θr: integrate there, with steps far below its
            // width.
            const double reach = 14.0 * std::sqrt(v);
            const double low = std::max(-theta_r - reach, -0.5 * std::numbers::pi);
            const double high = std::min(-theta_r + reach, 0.5 * std::numbers::pi);
            const double energy = integrate(low, high, 20000, [&](double theta_i) {
                return longitudinal_deon(v, theta_i, theta_r) * std::cos(theta_i);
            });
            EXPECT_NEAR(energy, 1.0, 1e-6) << "v = " << v << ", θr = " << degrees;
        }
    }
}

TEST(Longitudinal, GaussianLosesWhatFallsPastTheAxis) {
    for (const double beta : {0.02, 0.1, 0.4, 1.0}) {
        for (const double degrees : {0.0, 30.0, 80.0, 90.0}) {
            const double sin_r = std::sin(degrees * std::numbers::pi / 180.0);
            const double energy = integrate(-1.0, 1.0, 200000, [&](double sin_i) {
                return longitudinal_gaussian(beta, sin_i + sin_r, 0.0);
            });
            // Midpoint rule on a Gaussian cut at its peak: error below (step / β)² / 24.
            EXPECT_NEAR(energy, longitudinal_gaussian_energy(beta, sin_r), 1e-7);
        }
    }
    EXPECT_NEAR(longitudinal_gaussian_energy(0.1, 1.0), 0.5, 1e-12);
}

TEST(Longitudinal, GaussianApproachesDeonForNarrowLobes) {
    // To first order in v the two agree at the peak away from grazing: M = 1 / (√(2π v) cos θr)
    // over cos θi dθi against the Gaussian's density in sin θi.
    const double v = 1e-4;
    for (const double theta : {0.0, 0.4, 0.9}) {
        const double ratio =
            longitudinal_deon(v, -theta, theta) / longitudinal_gaussian(std::sqrt(v), 0.0, 0.0);
        EXPECT_NEAR(ratio * std::cos(theta), 1.0, 1e-3);
    }
}

}  // namespace
}  // namespace vellus::hair::reference
