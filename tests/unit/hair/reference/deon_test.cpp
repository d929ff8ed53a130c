#include "modules/hair/reference/deon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "modules/hair/reference/longitudinal.h"
#include "modules/hair/reference/quadrature.h"

namespace vellus::hair::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

TEST(Fibre, PathsOfAllOrdersConserveEnergy) {
    // Whatever enters leaves: Σ_p A(p, h) = 1 without absorption, so Σ_p ½ ∫ A dh = 1.
    for (const double theta_d : {0.0, 0.5, 1.2, 1.5}) {
        double sum = 0.0;
        for (int p = 0; p < 400; ++p) sum += lobe_attenuation({}, p, theta_d);
        EXPECT_NEAR(sum, 1.0, 1e-3) << theta_d;  // total reflection inside decays slowly
    }
    double sum = 0.0;
    for (int p = 0; p < 80; ++p) sum += path_attenuation({}, p, 0.3, 0.4);
    EXPECT_NEAR(sum, 1.0, 1e-14);
}

TEST(Deon, LongitudinalLobeIntegratesToOne) {
    // The rule of the other kind: adaptive Gauss-Kronrod in θi, split at the peak, against the
    // closed form's promise; 1e-10 is what the issue asks for.
    double worst = 0.0;
    for (int i = 0; i <= 36; ++i) {
        const double v = 1e-6 * std::pow(2e6, i / 36.0);
        for (const double degrees : {-90.0, -89.999, -70.0, -5.0, 0.0, 33.0, 85.0, 90.0, 97.0}) {
            const double theta_r = degrees * kDegree;
            const double peak = -std::asin(std::sin(theta_r));
            const double reach = 16.0 * std::sqrt(v);
            const auto f = [&](double theta_i) {
                return longitudinal_deon(v, theta_i, theta_r) * std::cos(theta_i);
            };
            const double low = std::max(peak - reach, -0.5 * kPi);
            const double high = std::min(peak + reach, 0.5 * kPi);
            const double energy = integrate_adaptive(low, peak, 1e-12, f, 8) +
                                  integrate_adaptive(peak, high, 1e-12, f, 8);
            worst = std::max(worst, std::abs(energy - 1.0));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 1e-10);
}

Fibre fibre_of(double absorption, double b_tt, double b_trt) {
    Fibre fibre;
    fibre.absorption = absorption;
    fibre.azimuthal = {0.0, b_tt, b_trt};
    return fibre;
}

TEST(Deon, AzimuthalLobeByThreeRoutes) {
    // Gauss-Legendre in γ (the reference), adaptive Gauss-Kronrod in h (singular slopes at |h| =
    // 1), and the cosine series.
    for (const double b : {0.05, 0.272, 0.635, 2.0}) {
        for (const double theta_d : {0.0, 0.7, 1.4, 1.57}) {
            const Fibre fibre = fibre_of(0.2, b, b);
            const double modified = modified_index(fibre.eta, theta_d);
            for (int p = 1; p <= 2; ++p) {
                const auto series = deon_azimuthal_series(fibre, p, theta_d,
                                                          8 + static_cast<int>(std::ceil(8.5 / b)));
                for (const double phi : {0.0, 0.3, 1.7, kPi}) {
                    const double value = deon_azimuthal(fibre, p, theta_d, phi);
                    const auto f = [&](double h) {
                        return 0.5 * path_attenuation(fibre, p, theta_d, h) *
                               wrapped_gaussian(phi - exit_azimuth(p, modified, h), b);
                    };
                    const double other = integrate_adaptive(-1.0, 0.0, 1e-12, f, 25) +
                                         integrate_adaptive(0.0, 1.0, 1e-12, f, 25);
                    const double energy = lobe_attenuation(fibre, p, theta_d);
                    EXPECT_NEAR(value, other, 1e-10 * energy / b + 1e-12);
                    EXPECT_NEAR(value, cosine_sum(series, phi), 1e-11 * energy / b + 1e-15);
                }
            }
        }
    }
}

TEST(Deon, AzimuthIntegratesToTheAttenuation) {
    for (const double theta_d : {0.0, 0.9, 1.5}) {
        const Fibre fibre = fibre_of(0.1, 0.635, 0.272);
        for (int p = 0; p < 3; ++p) {
            // R has a kink at φ = π: Gauss on [-π, π], where it is smooth inside.
            const double energy = integrate_gauss(
                -kPi, kPi, 256, [&](double phi) { return deon_azimuthal(fibre, p, theta_d, phi); });
            EXPECT_NEAR(energy, lobe_attenuation(fibre, p, theta_d), 1e-12);
        }
    }
}

TEST(Deon, IsReciprocalWithoutTilt) {
    const Fibre fibre = fibre_of(0.3, 0.635, 0.272);
    for (const double a : {-1.5, -0.4, 0.2, 1.1}) {
        for (const double b : {-1.2, 0.0, 0.9}) {
            const double there = deon(fibre, a, b, 1.0);
            EXPECT_NEAR(deon(fibre, b, a, -1.0), there, 1e-13 * (1.0 + there));
        }
    }
}

TEST(Deon, FurnaceAgreesWithTheDoubleIntegralAndItsKnownRange) {
    double least = 10.0;
    double most = 0.0;
    for (const float roughness : {0.2f, 0.3f, 0.6f, 1.0f}) {
        const Fibre fibre = karis_fibre({glm::vec3(1.0f), 0.5f, roughness, 1.0f, 0.0f}, 0);
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0}) {
            const double theta_r = degrees * kDegree;
            const double energy = deon_furnace(fibre, theta_r);
            least = std::min(least, energy);
            most = std::max(most, energy);
            if (roughness != 0.6f || degrees == 30.0) continue;
            const double direct = integrate_gauss(-0.5 * kPi, 0.5 * kPi, 120, [&](double theta_i) {
                return std::cos(theta_i) * integrate_gauss(-kPi, kPi, 48, [&](double phi) {
                           return deon(fibre, theta_i, theta_r, phi);
                       });
            });
            EXPECT_NEAR(energy, direct, 1e-8) << degrees;
        }
    }
    // Three of all orders, and an attenuation that changes over the lobe: .73 to 1.03 are known for
    // it.
    RecordProperty("least", std::to_string(least));
    RecordProperty("most", std::to_string(most));
    EXPECT_NEAR(least, 0.73, 0.03);
    EXPECT_LT(most, 1.03);
}

TEST(Deon, EdgesOfItsDomainAreFinite) {
    const double right = 0.5 * kPi;
    const double inf = std::numeric_limits<double>::infinity();
    for (const double v : {1e-6, 1e-3, 2.0}) {
        Fibre fibre = fibre_of(5.0, 0.635, 0.272);
        fibre.beta = {std::sqrt(v), std::sqrt(v), std::sqrt(v)};
        fibre.tilt = {-0.2, 0.1, 0.4};
        for (const double i : {-right, std::nextafter(-right, 0.0), 0.0, right}) {
            for (const double r : {-right, 0.0, std::nextafter(right, 0.0), right}) {
                for (const double phi : {0.0, 1.0, kPi, -kPi}) {
                    const double s = deon(fibre, i, r, phi);
                    EXPECT_GE(s, 0.0);
                    EXPECT_LT(s, inf);
                }
            }
        }
        for (const double h : {-1.0, 1.0, std::nextafter(1.0, 0.0)}) {
            for (int p = 0; p < 3; ++p) {
                const double a = path_attenuation(fibre, p, 0.3, h);
                EXPECT_NEAR(a, p == 0 ? 1.0 : 0.0, 1e-6);  // 1 - F falls with √(1 - h²) = 1.5e-8
            }
        }
    }
}

}  // namespace
}  // namespace vellus::hair::reference
