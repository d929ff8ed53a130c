#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "modules/character/mesh_library.h"
#include "modules/character/register.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/instantiate.h"
#include "tests/support/hair_scene.h"

// What technique deep_opacity lets through a slab of strands, against Beer and Lambert's law.
namespace vellus::hair {
namespace {

using test::HairScene;

constexpr uint32_t kSize = 128;
constexpr float kFov = 0.38f;
constexpr size_t kBands = 6;
constexpr float kHalf = 0.1f;        // of the slab's height and width
constexpr float kThickness = 0.04f;  // away from the eye
constexpr float kFront = -0.5f;
constexpr float kLength = 0.03f;  // of a strand
constexpr float kWidth = 0.0006f;
constexpr uint32_t kSlabs = 8;

/// Short strands along x, anywhere in a slab that light comes down through. To its middle they have
/// an optical depth of `most`.
StrandData slab(float most, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const float count = most * kThickness * 4.0f * (kHalf + kLength) / (kWidth * kLength);
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < static_cast<int>(count); ++i) {
        const float x = (2.0f * unit(random) - 1.0f) * (kHalf + kLength) - 0.5f * kLength;
        const float y = (2.0f * unit(random) - 1.0f) * kHalf;
        const float z = kFront - kThickness * unit(random);
        const float from = std::max(x, -kHalf);
        const float to = std::min(x + kLength, kHalf);
        if (to > from) strands.push_back({{from, y, z}, {to, y, z}});
    }
    return test::make_strands(strands, kWidth);
}

std::vector<glm::vec4> draw(gpu::Device& device, const StrandData& strands, ShadowTechnique shadow,
                            uint32_t map) {
    HairScene scene(device, kSize, kSize);
    scene.world.resource<light::ShadowSettings>() = {.size = map, .fit_to_picture = false};
    scene.world.get<scene::Camera>(scene.camera)->vertical_fov = kFov;
    scene.add_sun({0, 1, 0});
    HairExtension look;
    look.material.color_variation = 0.0f;
    look.width.tip_scale = 1.0f;
    scene.add_hair(strands, look,
                   {.opacity = OpacityTechnique::kDitherStill,
                    .shadow = shadow,
                    .multiple = MultipleTechnique::kNone,
                    .environment = EnvironmentTechnique::kNone});
    scene.build();
    return scene.draw();
}

/// Depth below the slab's top in slab halves that a row of the picture shows, half way through.
double depth_of_row(uint32_t row) {
    const double slope = std::tan(kFov / 2) * (1.0 - 2.0 * (row + 0.5) / kSize);
    return 1.0 + slope * (static_cast<double>(kFront) - 0.5 * static_cast<double>(kThickness)) /
                     static_cast<double>(kHalf);
}

struct Band {
    double through = 0.0;  ///< sum of what strands' pixels get of the light
    double depth = 0.0;    ///< sum of their depths, in slab halves
    double count = 0.0;
};

void add_rows(const std::vector<glm::vec4>& lit, const std::vector<glm::vec4>& shaded,
              std::array<Band, kBands>& bands) {
    for (uint32_t i = 0; i < kSize * kSize; ++i) {
        const double depth = depth_of_row(i / kSize);
        if (lit[i].g <= 0.0f || depth <= 0.0 || depth >= 1.0) continue;
        Band& band = bands[static_cast<size_t>(depth * kBands)];
        band.through += static_cast<double>(shaded[i].g / lit[i].g);
        band.depth += depth;
        band.count += 1.0;
    }
}

class DeepOpacityTest : public test::GpuTest {};

TEST_F(DeepOpacityTest, ASlabLetsThroughWhatBeerAndLambertSay) {
    for (const float most : {1.0f, 3.0f}) {
        // Texels from three strands wide to less than two.
        for (const uint32_t map : {256U, 512U}) {
            std::array<Band, kBands> bands;
            for (uint32_t seed = 0; seed < kSlabs; ++seed) {
                const StrandData strands = slab(most, seed);
                add_rows(draw(device(), strands, ShadowTechnique::kNone, map),
                         draw(device(), strands, ShadowTechnique::kDeepOpacity, map), bands);
            }
            for (size_t i = 0; i < kBands; ++i) {
                const Band& band = bands[i];
                ASSERT_GT(band.count, 3000.0);
                const double law = std::exp(-static_cast<double>(most) * band.depth / band.count);
                // Eight slabs of strands that lie by chance: a standard error of 0.01.
                EXPECT_NEAR(band.through / band.count, law, 0.03)
                    << "band " << i << ", depth " << most << ", map " << map;
            }
        }
    }
}

/// A white square below the slab that faces up and to the eye.
std::shared_ptr<asset::SceneAsset> skin() {
    asset::Primitive square;
    for (const auto& [x, along] : {std::pair{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}) {
        const float step = 0.02f * static_cast<float>(along);
        square.positions.emplace_back(0.05f * static_cast<float>(x), -kHalf - 0.05f + step,
                                      kFront - 0.25f * kThickness - step);
        square.normals.emplace_back(0.0f, std::sqrt(0.5f), std::sqrt(0.5f));
    }
    square.indices = {0, 1, 2, 0, 2, 3};
    square.material = 0;
    auto scene = std::make_shared<asset::SceneAsset>();
    scene->meshes = {{"skin", {square}, {}}};
    scene->materials = {{.metallic = 0.0f, .roughness = 1.0f}};
    scene->nodes = {{.name = "skin", .mesh = 0}};
    scene->roots = {0};
    return scene;
}

/// Mean brightness of the square below a slab of hair.
double draw_skin(gpu::Device& device, const StrandData& strands, ShadowTechnique shadow) {
    HairScene scene(device, kSize, kSize);
    character::register_character(scene.world, scene.schedule);
    character::register_character_passes(scene.world, scene.schedule);
    scene.world.resource<light::ShadowSettings>() = {.size = 512, .fit_to_picture = false};
    scene.add_sun({0, 1, 0});
    HairExtension look;
    look.width.tip_scale = 1.0f;
    scene.add_hair(strands, look, {.shadow = shadow, .environment = EnvironmentTechnique::kNone});
    EXPECT_TRUE(scene::instantiate(scene.world, skin()));
    EXPECT_TRUE(scene.world.resource<character::MeshLibrary>().update(
        device, scene.world.resource<scene::SceneLibrary>()));
    scene.build();
    const auto picture = scene.draw();
    double sum = 0.0;
    double count = 0.0;
    // Rows below the slab show nothing else.
    for (uint32_t y = kSize / 2 + kSize / 4 + 4; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) {
            const double value = picture[size_t{y} * kSize + x].g;
            sum += value;
            count += value > 0.0 ? 1.0 : 0.0;
        }
    }
    EXPECT_GT(count, 50.0);
    return sum;
}

TEST_F(DeepOpacityTest, SkinBelowASlabGetsWhatPassesAllOfIt) {
    double lit = 0.0;
    double shaded = 0.0;
    for (uint32_t seed = 0; seed < kSlabs; ++seed) {
        const StrandData strands = slab(0.5f, seed);
        lit += draw_skin(device(), strands, ShadowTechnique::kNone);
        shaded += draw_skin(device(), strands, ShadowTechnique::kDeepOpacity);
    }
    // An optical depth of one. A tenth of a metre behind the closest hair an exponential falloff of
    // 80 per metre leaves nothing.
    EXPECT_NEAR(shaded / lit, std::exp(-1.0), 0.04);
}

/// Thin strands along x, one every few pixels in one plane, and behind them a slab of which light
/// from `to_sun` meets `behind` strands.
TEST_F(DeepOpacityTest, DualScatteringKnowsHowMuchHairIsBehind) {
    constexpr uint32_t kPixels = 512;
    constexpr float kMiddle = 0.5f * kPixels;
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.0f, 0.3f, 1.0f));
    HairExtension look;
    look.width.tip_scale = 1.0f;
    look.material.base_color = look.material.tip_color = glm::vec3(0.9f);
    look.material.color_variation = 0.0f;
    std::vector<std::vector<glm::vec3>> rows;
    for (int i = -10; i <= 10; ++i) {
        const float y = 0.0043f * static_cast<float>(i);
        rows.push_back({{-kHalf, y, kFront + 0.005f}, {kHalf, y, kFront + 0.005f}});
    }
    const StrandData layer = test::make_strands(rows, 0.0008f);
    const auto draw_with = [&](float behind, MultipleTechnique multiple) {
        HairScene scene(device(), kPixels, kPixels);
        scene.world.resource<light::ShadowSettings>() = {.size = 128, .fit_to_picture = false};
        scene.world.get<scene::Camera>(scene.camera)->vertical_fov = kFov;
        scene.add_sun(to_sun);
        const HairTechniques techniques{.opacity = OpacityTechnique::kDitherStill,
                                        .shadow = ShadowTechnique::kDeepOpacity,
                                        .scattering = ScatteringTechnique::kSeriesB,
                                        .multiple = multiple,
                                        .environment = EnvironmentTechnique::kNone};
        scene.add_hair(layer, look, techniques);
        if (behind > 0.0f) {
            // slab() counts its strands along y.
            const float along_y = behind * to_sun.z * kHalf / kThickness;
            scene.add_hair(slab(along_y, 5), look, techniques);
        }
        scene.build();
        return scene.draw();
    };
    const auto alone = draw_with(0.0f, MultipleTechnique::kNone);
    const HairMaterial material;
    const glsl::HairSurface surface{glm::vec3(0.9f), 0.5f * material.specular, material.roughness,
                                    material.scatter, std::sin(material.shift)};
    glsl::HairFibre fibre{};
    fit_azimuthal({}, fibre);
    set_longitudinal(surface.roughness, surface.shift, fibre);
    std::vector<double> exact, drawn;
    for (const float behind : {0.0f, 2.0f}) {
        exact.push_back(0.0);
        drawn.push_back(0.0);
        const auto single = draw_with(behind, MultipleTechnique::kNone);
        const auto dual = draw_with(behind, MultipleTechnique::kDual);
        for (uint32_t i = 0; i < kPixels * kPixels; ++i) {
            const glm::vec2 at(i % kPixels, i / kPixels);
            if (alone[i].g <= 0.0f) continue;
            if (glm::any(glm::greaterThan(glm::abs(at - kMiddle), glm::vec2(0.5f * kMiddle))))
                continue;
            const glm::vec2 slope = std::tan(kFov / 2) * ((at + 0.5f) / kMiddle - 1.0f);
            const auto frame =
                glsl::hair_frame({1, 0, 0}, glm::normalize(glm::vec3(-slope.x, slope.y, 1.0f)));
            const auto value = glsl::dual_scattering(
                fibre, surface, frame, glsl::hair_eye(fibre, frame), to_sun, 1.0f, behind);
            drawn.back() += static_cast<double>(dual[i].g - single[i].g);
            exact.back() += static_cast<double>(value.g);
        }
    }
    // A quarter of what a strand covers of its texel stays in its own layer: 0.07 of a fibre, and
    // the first fibres count most.
    const double bound = 0.1 * exact[1];
    EXPECT_NEAR(drawn[0], exact[0], bound);
    EXPECT_NEAR(drawn[1], exact[1], bound);
}

}  // namespace
}  // namespace vellus::hair
