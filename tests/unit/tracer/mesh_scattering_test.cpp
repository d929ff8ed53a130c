#include "modules/hair/reference/tracer/mesh_scattering.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/tracer/scenes.h"

namespace vellus::hair::tracer {
namespace {

TEST(MeshScattering, SamplesGiveTheAlbedoThatQuadratureGives) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    const glm::dvec3 across = glm::normalize(glm::cross(n, glm::dvec3(1, 0, 0)));
    const glm::dvec3 beyond = glm::cross(n, across);
    for (const float roughness : {0.2f, 0.6f, 1.0f}) {
        for (const float metallic : {0.0f, 1.0f}) {
            for (const double angle : {0.2, 1.3}) {
                const glm::dvec3 eye = n * std::cos(angle) + across * std::sin(angle);
                const MeshScattering surface({glm::vec3(0.8f, 0.5f, 0.2f), metallic, roughness}, n,
                                             eye);
                glm::dvec3 exact(0.0);
                double density = 0.0;
                constexpr int kSteps = 600;
                for (int i = 0; i < kSteps; ++i) {
                    for (int j = 0; j < kSteps; ++j) {
                        const double z = (i + 0.5) / kSteps;
                        const double turn = 2.0 * std::numbers::pi * (j + 0.5) / kSteps;
                        const double r = std::sqrt(1.0 - z * z);
                        const glm::dvec3 l =
                            z * n + r * (std::cos(turn) * across + std::sin(turn) * beyond);
                        exact += surface.evaluate(l);
                        density += surface.pdf(l);
                    }
                }
                const double cell = 2.0 * std::numbers::pi / (kSteps * kSteps);
                exact *= cell;
                constexpr int kSamples = 20'000;
                int above = 0;
                const auto sampled = test::estimate(kSamples, [&](int i) {
                    Random random(2, 0, static_cast<uint32_t>(i));
                    const glm::dvec4 u = random.unit4();
                    const auto sample = surface.sample({u.x, u.y, u.z});
                    above += sample.pdf > 0.0 ? 1 : 0;
                    return sample.weight;
                });
                // Mirror directions below the horizon are lost: the density is that of the rest.
                const double share = density * cell;
                EXPECT_NEAR(above / double{kSamples}, share,
                            4.5 * std::sqrt(0.25 / kSamples) + 3e-3);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(sampled.mean[c], exact[c], 4.5 * sampled.error[c] + 3e-3 * exact[c])
                        << roughness << " " << metallic << " " << angle;
                }
                EXPECT_LT(sampled.variance.x, 2.0);
            }
        }
    }
}

}  // namespace
}  // namespace vellus::hair::tracer
