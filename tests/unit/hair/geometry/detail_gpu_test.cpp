#include <cmath>
#include <filesystem>
#include <glm/gtc/packing.hpp>

#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/upright.h"
#include "modules/hair/grow/grow.h"
#include "tests/support/hair_scene.h"

// Fewer, wider strands for distance cover what all strands cover.
namespace vellus::hair {
namespace {

using test::HairScene;
using DetailTest = test::GpuTest;

constexpr uint32_t kSize = 160;
constexpr int kFrames = 24;

HairExtension white(const Bounds& box, float distance) {
    HairExtension look;
    look.material.base_color = look.material.tip_color = glm::vec3(0.8f);
    look.material.use_groom_colors = false;
    look.translation = -glm::dvec3(box.center()) - glm::dvec3(0.0, 0.0, distance);
    return look;
}

HairTechniques unshadowed() {
    HairTechniques techniques;
    techniques.shadow = ShadowTechnique::kNone;
    return techniques;
}

/// Mean share of each pixel that is hair, over frames of moving dither.
std::vector<double> coverage(HairScene& scene) {
    std::vector<double> covered(size_t{kSize} * kSize);
    for (int frame = 0; frame < kFrames; ++frame) {
        const auto pixels = scene.draw();
        for (size_t i = 0; i < pixels.size(); ++i) covered[i] += pixels[i].g > 0.0f ? 1.0 : 0.0;
    }
    for (double& c : covered) c /= kFrames;
    return covered;
}

double total(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum;
}

/// Draws a groom `height` pixels high with every share of its strands and compares.
void expect_same_coverage(gpu::Device& device, const StrandData& strands, float height,
                          const char* name) {
    HairScene scene(device, kSize, kSize);
    scene.add_sun({0, 0, 1});
    const float pixel = 2.0f * std::tan(0.4f) / kSize;
    const float distance =
        strands.bounds.size().y / (height * pixel) + 0.5f * strands.bounds.size().z;
    const Entity hair = scene.add_hair(strands, white(strands.bounds, distance), unshadowed());
    scene.world.add(hair, HairDetail{.share = 1.0f});
    scene.build();
    const double all = total(coverage(scene));
    ASSERT_GT(all, 200.0) << name;
    for (const float share : {0.5f, 0.25f, 0.125f, 0.05f, 0.043f}) {
        scene.world.get<HairDetail>(hair)->share = share;
        const double some = total(coverage(scene));
        const HairFrame& frame = scene.world.resource<HairFrame>();
        const double kept = static_cast<double>(frame.effects[0].strands) /
                            static_cast<double>(strands.strand_count());
        fmt::print("{}, {} pixels high: {:.1f} % of the strands cover {:+.2f} %\n", name, height,
                   100.0 * kept, 100.0 * (some / all - 1.0));
        EXPECT_NEAR(some / all, 1.0, 0.03) << name << ", share " << share;
        EXPECT_GT(kept, 0.9 * share);
        EXPECT_LT(kept, 1.6 * share) << "levels are the square root of two apart";
        EXPECT_EQ(frame.segments, frame.draws[0].primitives);
        EXPECT_LT(frame.segments, 1.7 * share * static_cast<double>(strands.segment_count()))
            << "what is not drawn costs nothing";
    }
}

StrandData grown(GrowStyle style) {
    const GrowSurface head = sphere_surface(glm::vec3(0.0f), 0.09f, style == GrowStyle::kFur);
    GrowSettings settings = preset(style);
    // Few enough that three metres do not yet ask for the coarsest level.
    settings.count = 10'000;
    const auto groom = grow_groom(head, settings, 11);
    EXPECT_TRUE(groom);
    return prepare_strands(*groom, glm::dmat4(1.0), 9e-5f);
}

TEST_F(DetailTest, GrownHairKeepsItsCoverage) {
    expect_same_coverage(device(), grown(GrowStyle::kStraight), 90.0f, "straight");
    expect_same_coverage(device(), grown(GrowStyle::kCurly), 60.0f, "curly");
}

TEST_F(DetailTest, RealHairKeepsItsCoverage) {
    const auto path = std::filesystem::path(VELLUS_TEST_DATA) / "hair" / "straight.hair";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
    const auto loaded = load_groom(path);
    ASSERT_TRUE(loaded);
    const Upright upright = upright_transform(loaded->groom);
    const auto width = static_cast<float>(default_width(loaded->groom, upright.metres_per_unit));
    expect_same_coverage(device(), prepare_strands(loaded->groom, upright.to_metres, width), 90.0f,
                         "straight.hair");
}

TEST_F(DetailTest, SizeOnTheScreenDecidesWhereNothingElseDoes) {
    const StrandData strands = grown(GrowStyle::kStraight);
    uint32_t before = 0;
    for (const float distance : {0.6f, 3.0f, 30.0f}) {
        HairScene scene(device(), kSize, kSize);
        const Entity hair = scene.add_hair(strands, white(strands.bounds, distance), unshadowed());
        scene.world.add(hair, HairDetail{});
        scene.build();
        scene.draw();
        const uint32_t drawn = scene.world.resource<HairFrame>().effects[0].strands;
        if (distance > 1.0f) {
            EXPECT_LT(drawn, before) << distance;
        }
        before = drawn;
        scene.world.remove<HairDetail>(hair);
        scene.draw();
        EXPECT_EQ(scene.world.resource<HairFrame>().effects[0].strands, strands.strand_count())
            << "without the component all strands are drawn";
    }
    EXPECT_LT(before, strands.strand_count() / 20);
}

}  // namespace
}  // namespace vellus::hair
