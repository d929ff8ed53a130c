#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shaders/common/portable.h"
#include "tests/support/sampling.h"

namespace vellus::light {
namespace surface {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/pbr.glsl"
#include "common/tonemap.glsl"
}  // namespace surface

namespace {

constexpr double kPi = std::numbers::pi;

surface::PbrSurface material(const glm::vec3& color, float metallic, float roughness) {
    return {.base_color = color, .metallic = metallic, .roughness = roughness};
}

TEST(Pbr, ReflectsNoMoreThanArrives) {
    const glm::vec3 n(0, 0, 1);
    for (const float roughness : {0.2f, 0.5f, 1.0f}) {
        for (const float metallic : {0.0f, 1.0f}) {
            for (const double angle : {0.0, 0.8, 1.4}) {
                const auto s = material(glm::vec3(1.0f), metallic, roughness);
                const glm::vec3 view(std::sin(angle), 0.0, std::cos(angle));
                double energy = 0.0;
                constexpr int kSteps = 400;
                for (int i = 0; i < kSteps; ++i) {
                    for (int j = 0; j < kSteps; ++j) {
                        const double z = (i + 0.5) / kSteps;
                        const double phi = 2.0 * kPi * (j + 0.5) / kSteps;
                        const double across = std::sqrt(1.0 - z * z);
                        const glm::vec3 light(across * std::cos(phi), across * std::sin(phi), z);
                        energy += surface::pbr_direct(s, n, light, view).x * 2.0 * kPi /
                                  (kSteps * kSteps);
                    }
                }
                EXPECT_LT(energy, 1.01) << roughness << " " << metallic << " " << angle;
                EXPECT_GT(energy, 0.3);
            }
        }
    }
}

TEST(Pbr, IsReciprocal) {
    const glm::vec3 n(0, 0, 1);
    for (uint64_t i = 0; i < 10000; ++i) {
        test::Random random(1, i);
        glm::vec3 a = random.direction();
        glm::vec3 b = random.direction();
        a.z = std::abs(a.z);
        b.z = std::abs(b.z);
        if (std::min(a.z, b.z) < 0.05f) continue;
        const auto s =
            material({random.unit(), random.unit(), random.unit()},
                     static_cast<float>(random.unit()), static_cast<float>(random.unit()));
        const float there = surface::pbr_direct(s, n, a, b).x / a.z;
        const float back = surface::pbr_direct(s, n, b, a).x / b.z;
        EXPECT_NEAR(there, back, 1e-3f * (there + 1.0f));
    }
}

TEST(Pbr, EnvironmentOfOneIsReflectedByAtMostOne) {
    for (uint64_t i = 0; i < 10000; ++i) {
        test::Random random(2, i);
        const auto s =
            material({random.unit(), random.unit(), random.unit()},
                     static_cast<float>(random.unit()), static_cast<float>(random.unit()));
        const glm::vec3 value = surface::pbr_environment(s, static_cast<float>(random.unit()),
                                                         glm::vec3(1.0f), glm::vec3(1.0f));
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(value[c], 0.0f);
            EXPECT_LE(value[c], 1.0f + 1e-6f);
        }
    }
}

TEST(Tonemap, KeepsMidtonesAndCompressesHighlights) {
    // Khronos PBR Neutral: between black's toe and 0.76 + 0.04, colours only lose the 4 % of
    // Fresnel.
    const glm::vec3 brown(0.4f, 0.25f, 0.15f);
    EXPECT_NEAR(glm::length(surface::tonemap_pbr_neutral(brown) - (brown - 0.04f)), 0.0f, 1e-6f);
    float before = -1.0f;
    for (int i = 0; i < 120; ++i) {
        const float x = 1e-3f * (std::pow(1.1f, static_cast<float>(i)) - 1.0f);
        const glm::vec3 mapped = surface::tonemap_pbr_neutral(glm::vec3(x));
        EXPECT_GT(mapped.x, before);
        EXPECT_LE(mapped.x, 1.0f);
        before = mapped.x;
    }
}

TEST(Tonemap, EncodesSrgb) {
    for (int i = 0; i <= 1000; ++i) {
        const double x = i / 1000.0;
        const double exact = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        EXPECT_NEAR(surface::srgb_encode(static_cast<float>(x)), exact, 1e-6);
    }
}

TEST(Tonemap, DisplayTakesAnything) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float x :
         {0.0f, -1.0f, 1e-30f, 1.0f, 1e6f, 1e30f, infinity, -infinity, std::nanf("")}) {
        const glm::vec3 value = surface::display_color({x, 0.5f, 0.1f}, 1.3f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(value[c], 0.0f);
            EXPECT_LE(value[c], 1.0f);
        }
    }
}

}  // namespace
}  // namespace vellus::light
