#include "modules/hair/reference/dual_scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/hair/reference/deon.h"
#include "modules/hair/reference/quadrature.h"

namespace vellus::hair::reference {
namespace {

constexpr double kPi = std::numbers::pi;

Fibre fibre_of(float color, float roughness = 0.3f, float shift = 0.035f) {
    return karis_fibre({glm::vec3(color), 0.5f, roughness, 1.0f, shift}, 0);
}

TEST(DualScattering, SharesAreTheWeightedIntegralsOfTheScattering) {
    // The azimuth integrates in closed form in the reference; here all of S by plain quadrature.
    for (const float color : {0.05f, 1.0f}) {
        for (const double theta_i : {0.0, -1.3}) {
            const Fibre fibre = fibre_of(color, 0.6f);
            const DualAverages a = dual_averages(fibre, theta_i);
            double forward = 0.0;
            double all = 0.0;
            const GaussRule& rule = gauss_rule(96);
            const GaussRule& azimuths = gauss_rule(48);
            for (size_t i = 0; i < rule.node.size(); ++i) {
                const double theta_o = 0.5 * kPi * rule.node[i];
                for (size_t j = 0; j < azimuths.node.size(); ++j) {
                    const double phi = 0.5 * kPi * (1.0 + azimuths.node[j]);
                    const double s = deon(fibre, theta_i, theta_o, phi) * std::cos(theta_o) *
                                     rule.weight[i] * azimuths.weight[j] * 0.5 * kPi * kPi;
                    all += s;
                    forward += s * phi / kPi;
                }
            }
            EXPECT_NEAR(a.forward, forward, 1e-7);
            EXPECT_NEAR(a.forward + a.backward, all, 1e-7);  // identity: the albedo
        }
    }
}

TEST(DualScattering, HalfSpaceIsTheLimitOfManyLayers) {
    for (const double f : {0.0, 0.3, 0.6, 0.85}) {
        for (const double b : {0.0, 0.01, 0.1, 0.149}) {
            // Adding a layer in front of what is there: R' = b + f² R / (1 - b R).
            double stack = 0.0;
            for (int layer = 0; layer < 4000; ++layer) {
                stack = b + f * f * stack / (1.0 - b * stack);
            }
            EXPECT_NEAR(half_space_reflectance(f, b), stack, 1e-10) << f << " " << b;
            EXPECT_NEAR(backscatter_all_orders(f, b), stack - b, 1e-10);
        }
    }
}

TEST(DualScattering, ZinkesOrdersAreSumsOverTheReturningFibre) {
    // A_1 = Σ_i f^2i b; A_3 the triple sum over i and j, k of one backward event each way.
    const double f = 0.7;
    const double b = 0.2;
    double one = 0.0;
    for (int i = 1; i < 400; ++i) one += std::pow(f, 2.0 * i) * b;
    EXPECT_NEAR(backscatter_one(f, b), one, 1e-12);
    double three = 0.0;
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j <= 60; ++j) {
            for (int k = 0; k < 60; ++k) {
                three += std::pow(f, 2.0 * (i + j + k + 1)) * b * b * b;
            }
        }
    }
    EXPECT_NEAR(backscatter_three(f, b), three, 1e-7);
    EXPECT_LT(one + three, backscatter_all_orders(f, b));
}

TEST(DualScattering, WhiteHairHasClosedForms) {
    for (const double f : {0.2, 0.5, 0.8, 0.95}) {
        const double b = 1.0 - f;
        EXPECT_NEAR(half_space_reflectance(f, b), 1.0, 1e-7);  // √ of a rounding error
        EXPECT_NEAR(backscatter_all_orders(f, b), f, 1e-7);
        EXPECT_NEAR(backscatter_one(f, b), f * f / (1.0 + f), 1e-12);
        EXPECT_NEAR(backscatter_three(f, b), f * f / std::pow(1.0 + f, 3.0), 1e-12);
    }
    const DualAverages white = dual_averages(fibre_of(1.0f, 0.3f, 0.0f), 0.0);
    const double kept = (backscatter_one(white.forward, white.backward) +
                         backscatter_three(white.forward, white.backward)) /
                        backscatter_all_orders(white.forward, white.backward);
    RecordProperty("zinke_keeps", std::to_string(kept));
    EXPECT_LT(kept, 0.95);
}

TEST(DualScattering, SpreadsLieBetweenThoseOfTheLobes) {
    for (const float color : {0.0f, 0.3f, 1.0f}) {
        for (const double theta : {0.0, 0.8, 1.5}) {
            const Fibre fibre = fibre_of(color);
            const DualAverages a = dual_averages(fibre, theta);
            for (const double variance : {a.forward_variance, a.backward_variance}) {
                EXPECT_GE(variance, fibre.beta[1] * fibre.beta[1] * (1.0 - 1e-9));
                EXPECT_LE(variance, fibre.beta[2] * fibre.beta[2] * (1.0 + 1e-9));
            }
            EXPECT_TRUE(std::isfinite(backscatter_deviation(a, 0.7)));
            EXPECT_GT(backscatter_deviation(a, 0.7), 0.0);
        }
    }
    // Without absorption TT carries nearly all that goes on.
    const DualAverages white = dual_averages(fibre_of(1.0f), 0.0);
    EXPECT_GT(white.forward, 0.6);
    EXPECT_LT(white.forward_variance, 1.5 * std::pow(fibre_of(1.0f).beta[1], 2.0));
}

TEST(DualScattering, BlackHairOnlyReflects) {
    // R alone: of ¼ |cos φ/2| F the part |φ|/π goes on.
    const Fibre fibre = fibre_of(0.0f, 0.3f, 0.0f);
    const DualAverages a = dual_averages(fibre, 0.0);
    const double forward = 2.0 * integrate_gauss(0.0, kPi, 64, [&](double phi) {
                               return deon_azimuthal(fibre, 0, 0.0, phi) * phi / kPi;
                           });
    EXPECT_NEAR(a.forward, forward, 0.02 * forward);  // θd varies by β within the lobe
    EXPECT_LT(a.forward + a.backward, 0.15);
}

}  // namespace
}  // namespace vellus::hair::reference
