#include "modules/hair/reference/marschner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/deon.h"
#include "modules/hair/reference/dielectric.h"
#include "modules/hair/reference/quadrature.h"

namespace vellus::hair::reference {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Marschner, OffsetsLeaveWhereTheyShould) {
    for (const double modified : {1.3, 1.55, 1.999, 2.0, 2.5, 40.0}) {
        for (int p = 0; p < 3; ++p) {
            for (int step = 0; step <= 88; ++step) {
                const double phi = -3.1 + 0.07 * step;
                const auto offsets = offsets_of_azimuth(p, modified, phi);
                EXPECT_LE(offsets.size(), p < 2 ? 1u : 3u);
                for (const double h : offsets) {
                    const double miss =
                        std::remainder(exit_azimuth(p, modified, h) - phi, 2.0 * kPi);
                    EXPECT_NEAR(miss, 0.0, 1e-7);  // Φ moves by √ulp at |h| = 1
                }
            }
        }
    }
}

TEST(Marschner, EveryOffsetIsFoundAgain) {
    for (const double modified : {1.4, 1.7, 3.0}) {
        for (int p = 0; p < 3; ++p) {
            for (int step = 0; step < 64; ++step) {
                const double h = -0.98 + 0.0313 * step;
                const auto offsets = offsets_of_azimuth(p, modified, exit_azimuth(p, modified, h));
                EXPECT_TRUE(std::ranges::any_of(
                    offsets, [&](double found) { return std::abs(found - h) < 1e-6; }));
            }
        }
    }
}

TEST(Marschner, TransmissionKeepsItsEnergy) {
    // TT has no caustic: ∫ N dφ = ½ ∫ A dh, each by a rule of its own.
    Fibre fibre;
    fibre.absorption = 0.15;
    // Beyond θd = 1.0 Bravais's parallel index falls below 1 and A jumps at a total reflection.
    for (const double theta_d : {0.0, 0.5, 0.9}) {
        const double edge = exit_azimuth(1, modified_index(fibre.eta, theta_d), -1.0) - kPi;
        const double azimuths =
            integrate_tanh_sinh(kPi - edge, kPi + edge, 200, [&](double phi, double, double) {
                return marschner_azimuthal(fibre, 1, theta_d, phi);
            });
        const double offsets = integrate_gauss(0.0, 0.5 * kPi, 64, [&](double gamma) {
            return marschner_attenuation(fibre, 1, theta_d, std::sin(gamma)) * std::cos(gamma);
        });
        EXPECT_NEAR(azimuths, offsets, 1e-7) << theta_d;
    }
}

TEST(Marschner, InternalReflectionKeepsItsEnergyAcrossTheCaustic) {
    Fibre fibre;
    const double theta_d = 0.3;
    const double modified = modified_index(fibre.eta, theta_d);
    const double h = std::sqrt((4.0 - modified * modified) / 3.0);
    const double caustic = std::abs(std::remainder(exit_azimuth(2, modified, h), 2.0 * kPi));
    const double end = std::abs(std::remainder(exit_azimuth(2, modified, 1.0), 2.0 * kPi));
    const auto n = [&](double phi, double, double) {
        return std::min(marschner_azimuthal(fibre, 2, theta_d, phi), 1e7);  // infinite there
    };
    // Pieces end where N diverges (the caustic) and where a root comes in (|h| = 1).
    std::vector<double> edges = {0.0, std::min(caustic, end), std::max(caustic, end), kPi};
    double azimuths = 0.0;
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
        azimuths += 2.0 * integrate_tanh_sinh(edges[i], edges[i + 1], 400, n);
    }
    const double offsets = integrate_gauss(0.0, 0.5 * kPi, 64, [&](double gamma) {
        return marschner_attenuation(fibre, 2, theta_d, std::sin(gamma)) * std::cos(gamma);
    });
    // 1/√distance is cut at 3e-13 of the piece, and φ rounds there to 1e-16: √ of both.
    EXPECT_NEAR(azimuths / offsets, 1.0, 1e-4);
}

TEST(Marschner, BlurredByTheDetectorItIsDeon) {
    // At θd = 0 the two models' Fresnel factors agree; convolving Marschner's exact N with d'Eon's
    // detector gives d'Eon's N.
    Fibre fibre;
    fibre.absorption = 0.1;
    fibre.azimuthal = {0.0, 0.3, 0.3};
    const double edge = exit_azimuth(1, fibre.eta, -1.0) - kPi;
    for (const double phi : {0.5, 1.5, 2.5, kPi}) {
        const double blurred =
            integrate_tanh_sinh(kPi - edge, kPi + edge, 200, [&](double at, double, double) {
                return marschner_azimuthal(fibre, 1, 0.0, at) * wrapped_gaussian(phi - at, 0.3);
            });
        EXPECT_NEAR(blurred, deon_azimuthal(fibre, 1, 0.0, phi), 1e-7);
    }
    for (const double phi : {0.0, 1.0, 3.0}) {
        EXPECT_NEAR(marschner_azimuthal(fibre, 0, 0.0, phi), deon_azimuthal(fibre, 0, 0.0, phi),
                    1e-12);
    }
}

TEST(Marschner, FresnelIsExactInTheNormalPlane) {
    for (const double gamma : {0.0, 0.5, 1.2, 1.57}) {
        EXPECT_NEAR(marschner_fresnel(1.55, 0.0, gamma), fresnel_dielectric(std::cos(gamma), 1.55),
                    1e-12);
    }
    for (const double theta_d : {0.4, 1.2, 1.5}) {
        // Bravais' indices are exact for rays in the plane of the axis, h = 0.
        EXPECT_NEAR(marschner_fresnel(1.55, theta_d, 0.0),
                    fresnel_dielectric(std::cos(theta_d), 1.55), 1e-12);
    }
}

TEST(Marschner, GlintsMakeCausticsFinite) {
    const Fibre fibre;
    double jump = 0.0;
    for (const double theta_d : {0.0, 0.6, 0.95, 1.02, 1.5}) {
        double before = marschner_trt(fibre, theta_d, -kPi, {});
        for (int step = 0; step <= 6283; ++step) {
            const double phi = -kPi + 1e-3 * step;
            const double n = marschner_trt(fibre, theta_d, phi, {});
            EXPECT_GE(n, 0.0);
            EXPECT_LT(n, 10.0);
            jump = std::max(jump, std::abs(n - before));
            before = n;
        }
    }
    EXPECT_LT(jump, 0.05);
}

TEST(Marschner, AsPrintedIsReciprocal) {
    Fibre fibre;
    fibre.tilt = {-0.1, 0.05, 0.2};
    for (const double a : {-1.2, 0.1, 0.8}) {
        for (const double b : {-0.9, 0.3, 1.1}) {
            // S here is the paper's times cos θi.
            const double there = marschner(fibre, a, b, 0.7) / std::cos(a);
            EXPECT_NEAR(marschner(fibre, b, a, -0.7) / std::cos(b), there, 1e-12 * (1.0 + there));
        }
    }
}

TEST(Marschner, FurnaceOfNarrowLobesIsTheAlbedo) {
    // With narrow lobes M is a δ: ∫ S dω_i -> Σ_p ∫ N_p dφ, here R + TT.
    Fibre fibre;
    fibre.beta = {0.01, 0.01, 0.01};
    for (const double theta_r : {0.0, 0.5, 1.0}) {
        const double edge = exit_azimuth(1, modified_index(fibre.eta, theta_r), -1.0) - kPi;
        double energy = 0.0;
        for (int p = 0; p < 2; ++p) {
            const double reach = p == 0 ? kPi : edge;
            energy += integrate_gauss(-theta_r - 0.08, -theta_r + 0.08, 80, [&](double theta_i) {
                const double theta_d = 0.5 * (theta_r - theta_i);
                const double x = 0.5 * (theta_r + theta_i) / 0.005;
                const double m = 0.5 * std::exp(-0.5 * x * x) / (0.005 * std::sqrt(2.0 * kPi)) *
                                 std::cos(theta_i) / std::pow(std::cos(theta_d), 2.0);
                const double center = p * kPi;
                return m * std::cos(theta_i) *
                       integrate_gauss(center - reach, center + reach, 60, [&](double phi) {
                           return marschner_azimuthal(fibre, p, theta_d, phi);
                       });
            });
        }
        const double exact = integrate_gauss(0.0, 0.5 * kPi, 64, [&](double gamma) {
            const double h = std::sin(gamma);
            return (marschner_attenuation(fibre, 0, theta_r, h) +
                    marschner_attenuation(fibre, 1, theta_r, h)) *
                   std::cos(gamma);
        });
        EXPECT_NEAR(energy, exact, 2e-3) << theta_r;  // β² of second order
    }
}

}  // namespace
}  // namespace vellus::hair::reference
