#include "modules/hair/reference/kajiya_kay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/hair/reference/quadrature.h"
#include "tests/support/sampling.h"

namespace vellus::hair::reference {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(KajiyaKay, IsItsVectorForm) {
    // Kim's form with the sign put right: sin(T,L) sin(T,V) - (T·L)(T·V).
    for (uint64_t i = 0; i < 2000; ++i) {
        test::Random random(31, i);
        const glm::dvec3 t = random.direction();
        const glm::dvec3 l = random.direction();
        const glm::dvec3 v = random.direction();
        const double along_l = glm::dot(t, l);
        const double along_v = glm::dot(t, v);
        const double sin_l = glm::length(glm::cross(t, l));
        const double sin_v = glm::length(glm::cross(t, v));
        const double highlight = std::max(sin_l * sin_v - along_l * along_v, 0.0);
        const KajiyaKay k{0.3, 0.7, 40.0};
        EXPECT_NEAR(kajiya_kay(k, std::asin(along_l), std::asin(along_v)),
                    0.3 * sin_l + 0.7 * std::pow(highlight, 40.0), 1e-9);
    }
}

TEST(KajiyaKay, DiffuseFurnaceReturnsTheColour) {
    const glsl::HairSurface s{glm::vec3(0.25f, 0.5f, 1.0f), 0.0f, 0.3f, 1.0f, 0.0f};
    for (int channel = 0; channel < 3; ++channel) {
        const KajiyaKay k = kajiya_kay_parameters(s, channel);
        const double energy =
            2.0 * kPi * integrate_gauss(-0.5 * kPi, 0.5 * kPi, 32, [&](double theta) {
                return kajiya_kay(k, theta, 0.4) * std::cos(theta);
            });
        EXPECT_NEAR(energy, s.base_color[channel], 1e-12);
    }
}

TEST(KajiyaKay, HighlightIsReciprocalAndReflectsF0) {
    const glsl::HairSurface s{glm::vec3(0.0f), 0.5f, 0.3f, 1.0f, 0.0f};
    const KajiyaKay k = kajiya_kay_parameters(s, 0);
    EXPECT_NEAR(kajiya_kay(k, 0.3, -0.25), kajiya_kay(k, -0.25, 0.3), 1e-15);
    const double energy = 2.0 * kPi * integrate_gauss(-1.5, 1.5, 200, [&](double theta) {
                              return kajiya_kay(k, theta, 0.0) * std::cos(theta);
                          });
    // cos^p is a Gaussian up to β², 0.8 % at β = 0.09; so is the cosine of the integral.
    EXPECT_NEAR(energy, std::pow(0.55 / 2.55, 2.0), 0.01 * energy);
    EXPECT_EQ(kajiya_kay(k, 1.5, 1.5), 0.0);
}

}  // namespace
}  // namespace vellus::hair::reference
