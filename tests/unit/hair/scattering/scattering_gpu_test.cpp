#include <cmath>
#include <glm/gtc/packing.hpp>

#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/geometry/hair_passes.h"
#include "tests/support/hair_scene.h"

namespace vellus::hair {
namespace {

/// A patch of parallel strands before the camera, lit from the side.
StrandData patch() {
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < 40; ++i) {
        const float x = 0.002f * static_cast<float>(i) - 0.04f;
        strands.push_back({{x, 0.05f, -0.3f}, {x, 0.0f, -0.3f}, {x, -0.05f, -0.3f}});
    }
    return test::make_strands(strands, 0.003f);
}

HairTechniques unshadowed(ScatteringTechnique scattering, MultipleTechnique multiple) {
    return {.opacity = OpacityTechnique::kDitherStill,
            .shadow = ShadowTechnique::kNone,
            .scattering = scattering,
            .multiple = multiple,
            .environment = EnvironmentTechnique::kNone};
}

class ScatteringTest : public test::GpuTest {
  protected:
    /// The pixel in the middle of the picture, whose strand runs along -Y at the eye's own height.
    static constexpr uint32_t kSize = 65;

    glm::vec3 middle(ScatteringTechnique scattering, MultipleTechnique multiple,
                     const glm::vec3& to_sun, size_t* fits = nullptr) {
        test::HairScene scene(device(), kSize, kSize);
        HairExtension look;
        look.material.base_color = look.material.tip_color = {0.7f, 0.4f, 0.1f};
        look.material.color_variation = 0.0f;
        look.material.specular = 1.0f;  // 0.5 in a HairSurface
        scene.add_hair(patch(), look, unshadowed(scattering, multiple));
        scene.add_sun(to_sun);
        scene.build();
        const auto pixels = scene.draw();
        if (fits) *fits = scene.world.resource<FibreLibrary>().fitted();
        return pixels[size_t{kSize} * (kSize / 2) + kSize / 2];
    }
};

TEST_F(ScatteringTest, EveryTechniqueIsItsFunctionOnTheDevice) {
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.6f, 0.03f, 0.5f));
    for (uint32_t t = 0; t < kScatteringTechniques; ++t) {
        const auto technique = static_cast<ScatteringTechnique>(t);
        SCOPED_TRACE(t);
        size_t fits = 0;
        const glm::vec3 drawn = middle(technique, MultipleTechnique::kNone, to_sun, &fits);
        // What a scene does not choose costs nothing.
        EXPECT_EQ(fits, needs_fibre(technique, MultipleTechnique::kNone) ? 1u : 0u);
        const HairMaterial material;
        const glsl::HairSurface s{
            {0.7f, 0.4f, 0.1f}, 0.5f, material.roughness, 1.0f, std::sin(material.shift)};
        glsl::HairFibre fibre{};
        fit_azimuthal({}, fibre);
        set_longitudinal(s.roughness, s.shift, fibre);
        const auto frame = glsl::hair_frame({0, -1, 0}, {0, 0, 1});
        const glm::vec3 exact = glsl::hair_bsdf(static_cast<int>(t), fibre, s, frame,
                                                glsl::hair_eye(fibre, frame), to_sun);
        for (int c = 0; c < 3; ++c) {
            // Half floats; the pixel's centre and the eye's direction are off by less than a pixel.
            EXPECT_NEAR(drawn[c], exact[c], 0.03f * exact[c] + 2e-3f) << t << " " << c;
        }
        EXPECT_GT(exact.x, 1e-3f) << t;
    }
}

TEST_F(ScatteringTest, DualScatteringIsItsFunctionOnTheDevice) {
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.6f, 0.03f, 0.5f));
    const HairMaterial material;
    const glsl::HairSurface s{
        {0.7f, 0.4f, 0.1f}, 0.5f, material.roughness, 1.0f, std::sin(material.shift)};
    glsl::HairFibre fibre{};
    fit_azimuthal({}, fibre);
    set_longitudinal(s.roughness, s.shift, fibre);
    const auto frame = glsl::hair_frame({0, -1, 0}, {0, 0, 1});
    for (const auto scattering : {ScatteringTechnique::kKaris, ScatteringTechnique::kSeriesB}) {
        const glm::vec3 drawn = middle(scattering, MultipleTechnique::kDual, to_sun);
        const auto single = middle(scattering, MultipleTechnique::kNone, to_sun);
        const glm::vec3 exact =
            glsl::hair_direct(static_cast<int>(scattering), glsl::kMultipleDual, fibre, s, frame,
                              glsl::hair_eye(fibre, frame), to_sun, 1.0f, glsl::kDualMostFibres);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(drawn[c], exact[c], 0.03f * exact[c] + 2e-3f) << c;
            EXPECT_GT(drawn[c], single[c]);
        }
    }
}

TEST_F(ScatteringTest, TechniquesChangeFromFrameToFrame) {
    test::HairScene scene(device(), kSize, kSize);
    const Entity hair = scene.add_hair(
        patch(), {}, unshadowed(ScatteringTechnique::kKaris, MultipleTechnique::kFakeNormal));
    scene.add_sun(glm::normalize(glm::vec3(0.2f, 0.1f, 1.0f)));
    scene.build();
    const auto before = scene.draw();
    scene.world.get<HairTechniques>(hair)->scattering = ScatteringTechnique::kSeriesB;
    const auto between = scene.draw();
    EXPECT_EQ(scene.world.resource<FibreLibrary>().fitted(), 1u);
    scene.world.get<HairTechniques>(hair)->scattering = ScatteringTechnique::kKaris;
    const auto after = scene.draw();
    EXPECT_NE(before, between);
    EXPECT_EQ(before, after);
    EXPECT_EQ(scene.world.resource<FibreLibrary>().fitted(), 1u);
    EXPECT_EQ(scene.world.resource<HairPipelines>().shade.size(), 2u);
}

}  // namespace
}  // namespace vellus::hair
