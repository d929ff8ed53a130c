#include "lambert/lambert.h"

#include <numbers>

#include "modules/hair/scattering/fibre.h"
#include "tests/support/hair_scene.h"

namespace vellus::hair::glsl {
#include "lambert/lambert.glsl"
}  // namespace vellus::hair::glsl

namespace vellus::hair {
namespace {

using std::numbers::pi;

constexpr glm::vec3 kColor = {0.7f, 0.4f, 0.1f};

glm::vec3 lambert_of(glm::vec3 tangent, glm::vec3 to_eye, glm::vec3 to_light) {
    const auto frame = glsl::hair_frame(tangent, to_eye);
    return glsl::lambert_bsdf({kColor, 0.5f, 0.3f, 1.0f, 0.0f}, frame, to_light);
}

/// Radiance of a matt cylinder seen from azimuth 0, midpoint rule over the width the eye sees.
double brute_force(double cos_i, double phi) {
    constexpr int kSteps = 20'000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double across = 2.0 * (i + 0.5) / kSteps - 1.0;
        sum += std::max(std::cos(std::asin(across) - phi), 0.0);
    }
    return cos_i * sum / kSteps / pi;
}

TEST(Lambert, IsTheMeanOfLambertsLawOverTheWidthSeen) {
    for (const double theta : {0.0, 0.5, -1.2}) {
        for (int step = -10; step <= 10; ++step) {
            const double phi = 0.31 * step;
            const glm::vec3 to_light(std::cos(theta) * std::sin(phi), std::sin(theta),
                                     std::cos(theta) * std::cos(phi));
            const glm::vec3 s = lambert_of({0, 1, 0}, {0, 0, 1}, to_light);
            // Rounding of acos near 0 and the fade of the azimuth: below 1e-4.
            EXPECT_NEAR(s.x, kColor.x * brute_force(std::cos(theta), phi), 1e-4) << phi;
        }
    }
}

TEST(Lambert, ReturnsItsColourInAWhiteFurnace) {
    // Fibonacci points on the sphere: the mean times 4 pi, good to 1e-3 for 20,000 of them.
    constexpr int kPoints = 20'000;
    for (const double inclination : {0.0, 0.7, 1.4}) {
        const glm::vec3 to_eye(0, std::sin(inclination), std::cos(inclination));
        double sum = 0.0;
        for (int i = 0; i < kPoints; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / kPoints;
            const double turn = i * pi * (3.0 - std::sqrt(5.0));
            const double r = std::sqrt(1.0 - z * z);
            sum += lambert_of({0, 1, 0}, to_eye, {r * std::cos(turn), r * std::sin(turn), z}).x;
        }
        EXPECT_NEAR(sum / kPoints * 4.0 * pi, kColor.x, 2e-3) << inclination;
    }
}

class LambertTest : public test::GpuTest {};

TEST_F(LambertTest, IsChosenByItsIdAndDrawn) {
    ASSERT_TRUE(lambert::register_lambert());
    HairTechniques techniques{.opacity = OpacityTechnique::kDitherStill,
                              .shadow = ShadowTechnique::kNone,
                              .multiple = MultipleTechnique::kNone,
                              .environment = EnvironmentTechnique::kNone};
    ASSERT_TRUE(set_technique(techniques, "scattering", "lambert"));
    EXPECT_EQ(technique_id(techniques, "scattering"), "lambert");

    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < 40; ++i) {
        const float x = 0.002f * static_cast<float>(i) - 0.04f;
        strands.push_back({{x, 0.05f, -0.3f}, {x, -0.05f, -0.3f}});
    }
    constexpr uint32_t kSize = 65;
    test::HairScene scene(device(), kSize, kSize);
    HairExtension look;
    look.material.base_color = look.material.tip_color = kColor;
    look.material.color_variation = 0.0f;
    scene.add_hair(test::make_strands(strands, 0.003f), look, techniques);
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.6f, 0.3f, 0.5f));
    scene.add_sun(to_sun);
    scene.build();
    const glm::vec3 drawn = scene.draw()[size_t{kSize} * (kSize / 2) + kSize / 2];
    const glm::vec3 exact = lambert_of({0, -1, 0}, {0, 0, 1}, to_sun);
    for (int c = 0; c < 3; ++c) {
        // Half floats; the pixel's centre and the eye's direction are off by less than a pixel.
        EXPECT_NEAR(drawn[c], exact[c], 0.02f * exact[c] + 1e-3f) << c;
    }
}

TEST(AddedTechnique, ATakenIdIsRefusedAndWhatWasAddedStays) {
    const auto first = lambert::register_lambert();
    ASSERT_TRUE(first);
    EXPECT_EQ(*lambert::register_lambert(), *first);
    const auto again = add_scattering("lambert", {});
    ASSERT_FALSE(again);
    EXPECT_NE(again.error().message().find("lambert"), std::string::npos);
    EXPECT_FALSE(add_scattering("karis", {}));
    EXPECT_EQ(technique_ids("scattering").back(), "lambert");
    EXPECT_EQ(added_stage(ScatteringTechnique::kDeon), nullptr);
    EXPECT_EQ(added_stage(*first)->path, "lambert/shade.comp.glsl");
}

}  // namespace
}  // namespace vellus::hair
