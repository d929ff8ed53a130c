#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <set>

#include "tests/support/hair_scene.h"

// Whole frames of hair against coverage, order and shadow worked out by hand.
namespace vellus::hair {
namespace {

using test::HairScene;
using test::make_strands;

constexpr uint32_t kSize = 128;
constexpr float kDistance = 1.0f;
/// Metres a pixel covers at kDistance, by the camera of HairScene.
const float kPixel = 2.0f * std::tan(0.4f) / kSize * kDistance;

using HairTest = test::GpuTest;

/// A strand along X through pixel row centre `row` (0 is the middle), `pixels` long and wide.
std::vector<glm::vec3> horizontal(float row, float pixels) {
    const float y = -(row + 0.5f) * kPixel;
    return {{-0.5f * pixels * kPixel, y, -kDistance}, {0.5f * pixels * kPixel, y, -kDistance}};
}

/// Lit from the camera, white, so that every hair pixel is brighter than the black behind.
HairExtension white() {
    HairExtension look;
    look.material.base_color = look.material.tip_color = glm::vec3(0.8f);
    look.material.color_variation = 0.0f;
    look.width.tip_scale = 1.0f;
    return look;
}

size_t count_lit(const std::vector<glm::vec4>& pixels) {
    return static_cast<size_t>(
        std::ranges::count_if(pixels, [](const glm::vec4& p) { return p.g > 0.0f; }));
}

TEST_F(HairTest, OpaqueStrandCoversItsRectangle) {
    HairScene scene(device(), kSize, kSize);
    scene.add_sun({0, 0, 1});
    scene.add_hair(make_strands({horizontal(0.0f, 80.0f)}, 3.0f * kPixel), white());
    scene.build();
    const auto pixels = scene.draw();
    EXPECT_EQ(count_lit(pixels), 3u * 80u);
    for (uint32_t y = 0; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) {
            const bool inside = y >= 63 && y <= 65 && x >= 24 && x < 104;
            EXPECT_EQ(pixels[y * kSize + x].g > 0.0f, inside) << x << ", " << y;
        }
    }
}

TEST_F(HairTest, ThinStrandsKeepTheirCoverageOverFrames) {
    HairScene scene(device(), kSize, kSize);
    scene.add_sun({0, 0, 1});
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = -20; i <= 20; ++i) {
        const float y = static_cast<float>(3 * i) * kPixel;
        strands.push_back(
            {{-40.0f * kPixel, y, -kDistance}, {40.0f * kPixel, y + 17.0f * kPixel, -kDistance}});
    }
    constexpr float kWidth = 0.2f;
    scene.add_hair(make_strands(strands, kWidth * kPixel), white());
    scene.build();
    constexpr int kFrames = 32;
    double covered = 0.0;
    for (int frame = 0; frame < kFrames; ++frame)
        covered += static_cast<double>(count_lit(scene.draw()));
    // Area of 41 strands, some of which end outside; strands 3 pixels apart never overlap.
    double expected = 0.0;
    for (const auto& strand : strands) {
        const double slope = 17.0 / 80.0;
        const double length = std::hypot(80.0, 17.0);
        int columns_inside = 0;
        for (int x = 0; x < 80; ++x) {
            const double row = 64.0 - (strand[0].y / kPixel + slope * (x + 0.5));
            columns_inside += row >= 0.0 && row < kSize ? 1 : 0;
        }
        expected += kWidth * length * columns_inside / 80.0;
    }
    // The dither is stratified in time; 2 % is four times the spread seen between 32-frame means.
    EXPECT_NEAR(covered / kFrames, expected, 0.02 * expected);
}

TEST_F(HairTest, ColorsOfTheGroomReplaceThoseOfTheMaterial) {
    // As halves hold them.
    const glm::vec3 color(0.5f, 0.25f, 0.125f);
    StrandData strands = make_strands({horizontal(0.0f, 80.0f)}, 3.0f * kPixel);
    std::vector<glm::vec4> pictures[3];
    for (int k = 0; k < 3; ++k) {
        HairExtension look;
        look.material.color_variation = 0.0f;
        strands.has_color = k == 1;
        strands.color = glm::vec4(color, 1.0f);
        if (k == 0) look.material.base_color = look.material.tip_color = color;
        if (k == 2) {
            const glm::uvec2 halves(glm::packHalf2x16({color.r, color.g}),
                                    glm::packHalf2x16({color.b, 1.0f}));
            strands.point_color.assign(strands.positions.size(), halves);
        }
        HairScene scene(device(), kSize, kSize);
        scene.add_sun({0, 0, 1});
        scene.add_hair(strands, look);
        scene.build();
        pictures[k] = scene.draw();
    }
    EXPECT_EQ(pictures[1], pictures[0]) << "one colour";
    EXPECT_EQ(pictures[2], pictures[0]) << "a column of colours";
}

TEST_F(HairTest, TheNearerStrandIsSeenWhateverTheOrder) {
    for (const bool near_first : {true, false}) {
        HairScene scene(device(), kSize, kSize);
        scene.add_sun({0, 0, 1});
        HairTechniques bare;
        bare.shadow = ShadowTechnique::kNone;
        HairExtension red = white();
        red.material.base_color = red.material.tip_color = {0.8f, 0.0f, 0.0f};
        HairExtension green = white();
        green.material.base_color = green.material.tip_color = {0.0f, 0.8f, 0.0f};
        red.material.specular = green.material.specular = 0.0f;
        const auto far_strand =
            make_strands({{{-0.2f, 0, -1.0f}, {0.2f, 0, -1.0f}}}, 5.0f * kPixel);
        const auto near_strand =
            make_strands({{{0, -0.2f, -0.9f}, {0, 0.2f, -0.9f}}}, 5.0f * kPixel);
        if (near_first) {
            scene.add_hair(near_strand, red, bare);
            scene.add_hair(far_strand, green, bare);
        } else {
            scene.add_hair(far_strand, green, bare);
            scene.add_hair(near_strand, red, bare);
        }
        scene.build();
        const auto pixels = scene.draw();
        const glm::vec4 crossing = pixels[64 * kSize + 64];
        EXPECT_GT(crossing.r, 0.0f);
        EXPECT_EQ(crossing.g, 0.0f);
        EXPECT_GT(pixels[64 * kSize + 50].g, 0.0f);
    }
}

TEST_F(HairTest, HairBehindTheCameraIsNotDrawn) {
    HairScene scene(device(), kSize, kSize);
    scene.add_sun({0, 0, 1});
    scene.add_hair(make_strands({{{-1, 0, 1}, {1, 0, 1}}, {{0, 0, 0.5f}, {0, 0, -0.04f}}}, 0.01f),
                   white());
    scene.build();
    EXPECT_EQ(count_lit(scene.draw()), 0u);
}

TEST_F(HairTest, AlphaZeroIsThePictureWithoutHair) {
    HairScene scene(device(), kSize, kSize);
    scene.add_sun({0, 0, 1});
    HairExtension clear = white();
    clear.material.alpha = 0.0f;
    scene.add_hair(make_strands({horizontal(0.0f, 80.0f)}, 3.0f * kPixel), clear);
    scene.build();
    EXPECT_EQ(count_lit(scene.draw()), 0u);
    const auto& report = scene.executor->report();
    EXPECT_TRUE(std::ranges::none_of(report.passes, [](const graph::PassReport& pass) {
        return pass.name.starts_with("hair/");
    })) << "a groom that cannot be seen must cost no pass";
}

/// Mean green of the lit pixels in rows [first, last).
double mean_green(const std::vector<glm::vec4>& pixels, uint32_t first, uint32_t last) {
    double sum = 0.0;
    double count = 0.0;
    for (uint32_t i = first * kSize; i < last * kSize; ++i) {
        if (pixels[i].g <= 0.0f) continue;
        sum += pixels[i].g;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

TEST_F(HairTest, ShadowFallsOffExponentiallyWithDepth) {
    // The upper half of a curtain is shaded by a second one nearer to the light but outside the
    // picture's line of sight: the light shines down along -Y-Z, the camera looks along -Z.
    constexpr float kFalloff = 10.0f;
    constexpr float kGap = 0.1f;
    double shaded_share[2] = {};
    for (const bool shaded : {false, true}) {
        HairScene scene(device(), kSize, kSize);
        scene.add_sun(glm::normalize(glm::vec3(0, 1, 1)));
        std::vector<std::vector<glm::vec3>> strands;
        for (int i = -30; i <= 30; ++i) {
            const float y = static_cast<float>(i) * kPixel;
            strands.push_back({{-0.2f, y, -kDistance}, {0.2f, y, -kDistance}});
        }
        HairExtension look = white();
        look.material.scatter = 0.0f;
        const Entity curtain = scene.add_hair(make_strands(strands, 2.0f * kPixel), look);
        scene.world.get<HairShadow>(curtain)->falloff = kFalloff;
        if (shaded) {
            const glm::vec3 towards = glm::normalize(glm::vec3(0, 1, 1)) * kGap;
            for (auto& strand : strands) {
                for (auto& point : strand) point += towards;
            }
            HairExtension invisible = white();
            const Entity second = scene.add_hair(make_strands(strands, 2.0f * kPixel), invisible);
            scene.world.get<HairShadow>(second)->falloff = kFalloff;
        }
        scene.build();
        const auto pixels = scene.draw();
        // The second curtain ends at row 85: below it the eye sees only the first one.
        shaded_share[shaded ? 1 : 0] = mean_green(pixels, 87, 92);
    }
    // Transmittance e^(-falloff (gap - first - texel)); the map's texel is about 1 mm here.
    const double expected = std::exp(-kFalloff * (kGap - 0.002 - 0.001));
    EXPECT_NEAR(shaded_share[1] / shaded_share[0], expected, 0.02);
}

TEST_F(HairTest, SteadyFramesMakeNothing) {
    HairScene scene(device(), kSize, kSize);
    scene.add_sun({0, 0, 1});
    scene.add_hair(make_strands({horizontal(0.0f, 80.0f), horizontal(9.0f, 60.0f)}, kPixel),
                   white());
    scene.world.resource<temporal::TemporalSettings>().enabled = true;
    scene.build();
    for (int frame = 0; frame < 4; ++frame) scene.draw();
    const size_t pipelines = device().pipelines().created();
    const uint64_t objects = scene.executor->objects_created();
    const uint64_t bytes = device().memory().bytes_in_use();
    for (int frame = 0; frame < 8; ++frame) scene.draw();
    EXPECT_EQ(device().pipelines().created(), pipelines);
    EXPECT_EQ(scene.executor->objects_created(), objects);
    EXPECT_EQ(device().memory().bytes_in_use(), bytes);
}

TEST_F(HairTest, TheSameFrameTwiceIsTheSame) {
    std::vector<std::vector<glm::vec4>> pictures;
    for (int run = 0; run < 2; ++run) {
        HairScene scene(device(), kSize, kSize);
        scene.add_sun(glm::normalize(glm::vec3(0.3f, 0.4f, 1)));
        std::vector<std::vector<glm::vec3>> strands;
        for (int i = 0; i < 200; ++i) {
            const float a = static_cast<float>(i) * 0.37f;
            strands.push_back({{0.3f * std::cos(a), 0.3f * std::sin(a), -1.0f},
                               {0.1f * std::sin(3 * a), 0.1f * std::cos(2 * a), -1.2f}});
        }
        scene.add_hair(make_strands(strands, 0.5f * kPixel), white());
        scene.build();
        for (int frame = 0; frame < 3; ++frame) scene.draw();
        pictures.push_back(scene.draw());
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

TEST_F(HairTest, FarFromTheOriginThePictureIsTheSame) {
    std::vector<std::vector<glm::vec4>> pictures;
    for (const double offset : {0.0, 1e3, 1e6}) {
        HairScene scene(device(), kSize, kSize);
        scene.add_sun(glm::normalize(glm::vec3(0.3f, 0.4f, 1)));
        const Entity hair = scene.add_hair(
            make_strands({horizontal(0.0f, 80.0f), horizontal(20.0f, 50.0f)}, 3.0f * kPixel),
            white());
        scene.world.get<scene::LocalTransform>(hair)->translation = {offset, offset, -offset};
        scene.world.get<scene::LocalTransform>(scene.camera)->translation = {offset, offset,
                                                                             -offset};
        scene.build();
        pictures.push_back(scene.draw());
    }
    for (size_t i = 1; i < pictures.size(); ++i) {
        for (size_t pixel = 0; pixel < pictures[0].size(); ++pixel) {
            // Doubles hold 1e6 m to 1e-10 m, so only their rounding shows.
            EXPECT_NEAR(pictures[i][pixel].g, pictures[0][pixel].g, 1.0 / 255) << pixel;
        }
    }
}

}  // namespace
}  // namespace vellus::hair
