#include <gtest/gtest.h>

#include <cmath>

#include "modules/hair/shadow/deep_opacity_glsl.h"

namespace vellus::hair {
namespace {

constexpr float kSpan = 0.12f;

/// Where layer k begins, by the header's first lines.
double begin_of(uint32_t k) {
    if (k == glsl::kDeepLayers) return kSpan / 0.3;
    const double layers = glsl::kDeepLayers - 1.0;
    return kSpan * k * (k + 1.0) / (layers * (layers + 1.0));
}

TEST(DeepOpacity, PlacesDepthsBetweenTheEndsOfTheirLayer) {
    for (int i = 0; i <= 100'000; ++i) {
        const float depth = kSpan / 0.3f * static_cast<float>(i) / 100'000.0f;
        const auto place = glsl::deep_place(depth, kSpan);
        ASSERT_LT(place.layer, glsl::kDeepLayers);
        const double begin = begin_of(place.layer);
        const double end = begin_of(place.layer + 1);
        // Depth back from layer and share: float keeps it to some 1e-7 of the span.
        EXPECT_NEAR(begin + (end - begin) * place.share, depth, 1e-6 * kSpan) << depth;
    }
}

TEST(DeepOpacity, DepthsBeyondTheLastLayerAreItsEnd) {
    for (const float depth : {kSpan / 0.3f, 4.0f * kSpan, 1e30f}) {
        const auto place = glsl::deep_place(depth, kSpan);
        EXPECT_EQ(place.layer, glsl::kDeepLayers - 1);
        EXPECT_FLOAT_EQ(place.share, 1.0f);
    }
    const auto front = glsl::deep_place(0.0f, kSpan);
    EXPECT_EQ(front.layer, 0u);
    EXPECT_EQ(front.share, 0.0f);
}

TEST(DeepOpacity, StrandsThatCoverAShareOfATexelLetTheRestThroughEach) {
    for (const float share : {0.01f, 0.2f, 0.7f}) {
        const float five = 5.0f * glsl::deep_optical_depth_of(share);
        EXPECT_NEAR(std::exp(-five), std::pow(1.0f - share, 5.0f), 1e-5f) << share;
    }
    EXPECT_EQ(glsl::deep_optical_depth_of(-1.0f), 0.0f);
    // A texel that is covered all over passes a thousandth: units are finite.
    EXPECT_NEAR(std::exp(-glsl::deep_optical_depth_of(2.0f)), 1e-3f, 1e-5f);
}

TEST(DeepOpacity, UnitsRoundAndNeverGoNegative) {
    EXPECT_EQ(glsl::deep_units(-1.0f), 0u);
    EXPECT_EQ(glsl::deep_units(1.0f), 4096u);
    // A hundredth of a texel, ten thousand times: the error of rounding stays below a percent.
    EXPECT_NEAR(10'000.0 * glsl::deep_units(0.01f) / 4096.0, 100.0, 1.0);
}

}  // namespace
}  // namespace vellus::hair
