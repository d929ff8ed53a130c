#include <gtest/gtest.h>

#include "game_demo/tools/accuracy/frames.h"
#include "game_demo/tools/accuracy/radiance.h"

namespace vellus::demo {
namespace {

Radiance picture(const std::vector<float>& greys) {
    Radiance result{{static_cast<uint32_t>(greys.size()), 1}, {}};
    for (const float grey : greys) result.pixels.emplace_back(grey);
    return result;
}

TEST(AccuracyErrors, OfPicturesKnownByHand) {
    const Reference reference{.picture = picture({1, 2, 5}), .weight = {1, 1, 0}};
    const Radiance other = picture({2, 2, 100});
    EXPECT_DOUBLE_EQ(relative_l1(other, reference), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(relative_l2(other, reference), std::sqrt(1.0 / 5.0));
    EXPECT_DOUBLE_EQ(mean_difference(other, reference), 0.5);
    EXPECT_DOUBLE_EQ(relative_bias(other, reference), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(relative_bias(picture({0, 2, 0}), reference), -1.0 / 3.0);
    EXPECT_DOUBLE_EQ(relative_l1(reference.picture, reference), 0.0);
}

TEST(AccuracyErrors, BlocksForgiveWhatEvensOutWithinThem) {
    Reference reference{.picture = picture({1, 1, 1, 1}), .weight = {1, 1, 1, 1}};
    const Radiance noisy = picture({2, 0, 1, 2});
    EXPECT_DOUBLE_EQ(relative_l1(noisy, reference), 3.0 / 4.0);
    reference.block = 2;
    EXPECT_DOUBLE_EQ(relative_l1(noisy, reference), 1.0 / 4.0);
    EXPECT_DOUBLE_EQ(mean_difference(noisy, reference), 1.0 / 4.0);
    reference.block = 4;
    EXPECT_DOUBLE_EQ(relative_l1(noisy, reference), 1.0 / 4.0);
}

TEST(AccuracyErrors, FlickerIsTheSpreadInTime) {
    const Reference reference{.picture = picture({1, 1}), .weight = {1, 1}};
    const std::vector<Radiance> frames = {picture({0, 1}), picture({2, 1})};
    // The first pixel is 1 ± 1, the second still.
    EXPECT_DOUBLE_EQ(flicker(frames, reference), 0.5);
    EXPECT_EQ(mean_of(frames).pixels[0], glm::vec3(1));
}

TEST(AccuracyFrames, EveryPassOfHairBelongsToTheAxesItServes) {
    EXPECT_TRUE(belongs("hair/visibility", "opacity"));
    EXPECT_TRUE(belongs("temporal/taa", "opacity"));
    EXPECT_FALSE(belongs("hair/shade", "opacity"));
    EXPECT_TRUE(belongs("hair/shadow_depth", "shadow"));
    EXPECT_TRUE(belongs("hair/shade", "shadow")) << "the map is looked up there";
    EXPECT_FALSE(belongs("hair/shadow_depth", "scattering"));
    EXPECT_TRUE(belongs("hair/shade", "scattering"));
    EXPECT_TRUE(belongs("display/tonemap", kFrameAxis));
    EXPECT_FALSE(belongs("display/tonemap", "shadow"));
}

}  // namespace
}  // namespace vellus::demo
