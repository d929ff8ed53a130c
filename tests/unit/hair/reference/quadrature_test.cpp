#include "modules/hair/reference/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vellus::hair::reference {
namespace {

TEST(Quadrature, GaussIsExactForPolynomialsOfItsDegree) {
    for (const int count : {1, 2, 5, 16, 64, 200}) {
        const int degree = 2 * count - 1;
        // ∫ (x^degree + x^(degree-1)) over [-1, 1] = 2 / degree for odd degree.
        const double value = integrate_gauss(-1.0, 1.0, count, [&](double x) {
            return std::pow(x, degree) + std::pow(x, degree - 1);
        });
        EXPECT_NEAR(value, 2.0 / degree, 1e-14) << count;
    }
}

TEST(Quadrature, KronrodPairIsExactAndKnowsItsError) {
    for (int degree = 0; degree <= 22; ++degree) {
        const auto [value, error] =
            kronrod_step(0.0, 1.0, [&](double x) { return std::pow(x, degree); });
        EXPECT_NEAR(value, 1.0 / (degree + 1), 1e-14);
        EXPECT_TRUE(degree > 13 || error < 1e-14) << degree;
    }
    EXPECT_GT(kronrod_step(0.0, 1.0, [](double x) { return std::pow(x, 14); })[1], 1e-13);
}

TEST(Quadrature, RulesOfDifferentKindAgree) {
    // A narrow Gaussian beside a smooth wave: ∫ over the circle of e^(κ cos x) = 2π I0(κ).
    const auto f = [](double x) { return std::exp(30.0 * (std::cos(x) - 1.0)); };
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double periodic = integrate_periodic(0.0, kTurn, 128, f);
    EXPECT_NEAR(integrate_adaptive(-std::numbers::pi, std::numbers::pi, 1e-13, f) / periodic, 1.0,
                1e-12);
    EXPECT_NEAR(integrate_gauss(-std::numbers::pi, std::numbers::pi, 160, f) / periodic, 1.0,
                1e-12);
}

TEST(Quadrature, TanhSinhTakesSingularEnds) {
    const double arc = integrate_tanh_sinh(
        -1.0, 1.0, 60, [](double, double low, double high) { return 1.0 / std::sqrt(low * high); });
    EXPECT_NEAR(arc, std::numbers::pi, 2e-6);  // what lies within 3e-13 of the ends: 4 √3e-13
    const double log =
        integrate_tanh_sinh(0.0, 1.0, 60, [](double, double low, double) { return std::log(low); });
    EXPECT_NEAR(log, -1.0, 1e-10);
}

}  // namespace
}  // namespace vellus::hair::reference
