#include <gtest/gtest.h>

#include "game_demo/src/accuracy/groom_class.h"
#include "game_demo/src/accuracy/spend_budget.h"
#include "modules/hair/groom/hair_material.h"
#include "modules/hair/grow/grow.h"

namespace vellus::demo {
namespace {

std::string_view kind_of(hair::GrowStyle style) {
    hair::GrowSettings settings = hair::preset(style);
    settings.count = 400;
    const bool fur = style == hair::GrowStyle::kFur;
    const auto groom =
        hair::grow_groom(hair::sphere_surface({0, 1.6f, 0}, 0.095f, fur), settings, 1);
    EXPECT_TRUE(groom);
    return groom_kind(groom->points, groom->strand_begin, 1.0);
}

TEST(AccuracyGroom, KnowsGrownStylesByTheirStrands) {
    EXPECT_EQ(kind_of(hair::GrowStyle::kStraight), "straight");
    EXPECT_EQ(kind_of(hair::GrowStyle::kBob), "straight");
    EXPECT_EQ(kind_of(hair::GrowStyle::kWavy), "wavy");
    EXPECT_EQ(kind_of(hair::GrowStyle::kCurly), "curly");
    EXPECT_EQ(kind_of(hair::GrowStyle::kFur), "fur");
    EXPECT_EQ(groom_kind({}, {}, 1.0), "straight") << "nothing is nothing special";
}

TEST(AccuracyGroom, KnowsColoursByTheirBrightness) {
    EXPECT_EQ(colour_kind(glm::vec3(0.0f)), "black");
    EXPECT_EQ(colour_kind(hair::melanin_color({8.0f, 0.0f})), "black");
    EXPECT_EQ(colour_kind(hair::melanin_color({1.3f, 0.0f})), "brown");
    EXPECT_EQ(colour_kind(hair::melanin_color({0.3f, 0.1f})), "blond");
    EXPECT_EQ(colour_kind(glm::vec3(0.95f)), "white");
}

graph::FrameReport report(double hair_ms, double other_ms) {
    graph::FrameReport result;
    result.passes = {{.name = "hair/shade", .gpu_ms = 0.75 * hair_ms},
                     {.name = "hair/visibility", .gpu_ms = 0.25 * hair_ms},
                     {.name = "light/sky", .gpu_ms = other_ms}};
    return result;
}

TEST(AccuracyGroom, AFrameIsWatchedUntilItIsWarm) {
    FrameWatch watch;
    int frames = 0;
    std::optional<FrameShare> share;
    for (; !watch.done(); ++frames) {
        EXPECT_FALSE(share);
        // The first frames make pipelines; one of the others meets a busy moment.
        share = watch.add(report(frames < 4 ? 500.0 : frames == 6 ? 90.0 : 8.0, 2.0));
    }
    EXPECT_EQ(frames, 12);
    ASSERT_TRUE(share);
    EXPECT_DOUBLE_EQ(share->hair_ms, 8.0);
    EXPECT_DOUBLE_EQ(share->other_ms, 2.0);
    EXPECT_FALSE(watch.add(report(8, 2))) << "said once";
}

}  // namespace
}  // namespace vellus::demo
