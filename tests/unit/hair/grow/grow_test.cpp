#include "modules/hair/grow/grow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/platform/hash.h"
#include "modules/hair/groom/groom_report.h"

namespace vellus::hair {
namespace {

constexpr float kRadius = 0.09f;

GrowSurface ball(bool whole = false) {
    return sphere_surface(glm::vec3(0.0f), kRadius, whole);
}

GrowSettings small(GrowStyle style) {
    GrowSettings settings = preset(style);
    settings.count = 600;
    settings.guides = 80;
    return settings;
}

uint64_t hash_of(const Groom& groom) {
    return fnv1a(std::as_bytes(std::span(groom.points)));
}

class EveryStyle : public testing::TestWithParam<GrowStyle> {};

TEST_P(EveryStyle, GrowsTheStrandsAskedForOutsideTheBody) {
    const bool whole = GetParam() == GrowStyle::kFur;
    Groom groom = *grow_groom(ball(whole), small(GetParam()), 1);
    ASSERT_EQ(groom.strand_count(), 600u);
    ASSERT_EQ(groom.points.size(), size_t{600} * preset(GetParam()).points);
    const GroomReport report = repair(groom);
    EXPECT_EQ(report.strands, 600u) << to_text(report);
    EXPECT_EQ(report.non_finite_strands, 0u);
    for (const glm::vec3& p : groom.points) {
        // The ball is made of flat triangles, up to a 2000th of its radius inside the true one.
        EXPECT_GT(glm::length(p), kRadius * 0.998f);
    }
    for (size_t s = 0; s < groom.strand_count(); ++s) {
        const float root = glm::length(groom.points[groom.strand_begin[s]]);
        EXPECT_LT(root, kRadius * 1.0005f) << "roots lie on the skin";
    }
}

TEST_P(EveryStyle, TheSameSeedGrowsTheSameBitsAnotherOthers) {
    const bool whole = GetParam() == GrowStyle::kFur;
    const uint64_t first = hash_of(*grow_groom(ball(whole), small(GetParam()), 7));
    EXPECT_EQ(hash_of(*grow_groom(ball(whole), small(GetParam()), 7)), first);
    EXPECT_NE(hash_of(*grow_groom(ball(whole), small(GetParam()), 8)), first);
}

TEST_P(EveryStyle, LargerHeadsWearTheSameStyle) {
    const GrowSettings settings = small(GetParam());
    const bool whole = GetParam() == GrowStyle::kFur;
    const Groom small_head = *grow_groom(ball(whole), settings, 2);
    const float factor = 4.0f;  // exact in binary
    const GrowSurface large = sphere_surface(glm::vec3(0.0f), factor * kRadius, whole);
    const Groom large_head = *grow_groom(large, scale_to(settings, factor), 2);
    ASSERT_EQ(small_head.points.size(), large_head.points.size());
    // Thresholds fall differently for single hairs: their mean places agree.
    glm::dvec3 mean_small(0.0);
    glm::dvec3 mean_large(0.0);
    for (size_t p = 0; p < small_head.points.size(); ++p) {
        mean_small += glm::dvec3(small_head.points[p]);
        mean_large += glm::dvec3(large_head.points[p]) / double{factor};
    }
    const auto count = static_cast<double>(small_head.points.size());
    EXPECT_LT(glm::distance(mean_small, mean_large) / count, 0.02 * kRadius);
}

INSTANTIATE_TEST_SUITE_P(Styles, EveryStyle,
                         testing::Values(GrowStyle::kStraight, GrowStyle::kBob, GrowStyle::kWavy,
                                         GrowStyle::kCurly, GrowStyle::kCoily, GrowStyle::kPonytail,
                                         GrowStyle::kBraid, GrowStyle::kShort, GrowStyle::kFur),
                         [](const auto& tested) {
                             return std::string(grow_style_name(tested.param));
                         });

double strand_length(const Groom& groom, size_t strand) {
    double length = 0.0;
    for (uint32_t p = groom.strand_begin[strand]; p + 1 < groom.strand_begin[strand + 1]; ++p) {
        length += glm::distance(groom.points[p], groom.points[p + 1]);
    }
    return length;
}

TEST(GrowGroom, LengthsFollowTheSettings) {
    GrowSettings settings = small(GrowStyle::kStraight);
    settings.count = 4000;
    settings.frizz = settings.clumping = 0.0f;
    settings.length = 0.3f;
    settings.length_variation = 0.5f;
    const Groom groom = *grow_groom(ball(), settings, 3);
    // A hair is shorter by v u^2, u even in [0, 1): shares of 1 - v u^2 up to x come as
    // 1 - sqrt((1 - x) / v).
    std::vector<double> shares;
    for (size_t s = 0; s < groom.strand_count(); ++s) {
        shares.push_back(strand_length(groom, s) / settings.length);
    }
    std::ranges::sort(shares);
    double worst = 0.0;
    for (size_t i = 0; i < shares.size(); ++i) {
        const double below = 1.0 - std::sqrt(std::clamp((1.0 - shares[i]) / 0.5, 0.0, 1.0));
        worst = std::max(worst, std::abs(below - static_cast<double>(i) / shares.size()));
    }
    // Kolmogorov-Smirnov at 1 % would be 0.026; blending neighbours that part ways, and points
    // pushed out of the body, change single lengths by a few percent.
    EXPECT_LT(worst, 0.12);
    EXPECT_GT(shares.front(), 0.40);
    EXPECT_LT(shares.back(), 1.10);
}

TEST(GrowGroom, TaperAndWidthBecomeTheDiameterColumn) {
    GrowSettings settings = small(GrowStyle::kShort);
    settings.width = 8e-5f;
    settings.taper = 0.75f;
    const Groom groom = *grow_groom(ball(), settings, 1);
    EXPECT_FLOAT_EQ(thickness_at(groom, 0, 0), 8e-5f);
    EXPECT_FLOAT_EQ(thickness_at(groom, 0, settings.points - 1), 2e-5f);
    settings.taper = 0.0f;
    EXPECT_TRUE(grow_groom(ball(), settings, 1)->thickness.empty());
}

TEST(GrowGroom, RootsLieCloserWhereHairPartsAndSomeCrossTheParting) {
    GrowSettings settings = preset(GrowStyle::kStraight);
    settings.count = 4000;
    settings.parting = 0.0f;
    settings.flyaways = 0.0f;
    const Groom groom = *grow_groom(ball(), settings, 3);
    uint32_t near = 0;
    uint32_t aside = 0;
    uint32_t crossing = 0;
    for (size_t s = 0; s < groom.strand_count(); ++s) {
        // Two stripes of equal area on the ball, for a stripe's area is its width times 2 pi r:
        // over the parting and down the sides, both well inside the haired part of the top.
        const glm::vec3 root = groom.points[groom.strand_begin[s]] / kRadius;
        if (root.z < 0.15f || root.y < 0.65f) continue;
        const glm::vec3 tip = groom.points[groom.strand_begin[s + 1] - 1] / kRadius;
        near += std::abs(root.x) < 0.1f ? 1u : 0u;
        aside += std::abs(root.x) > 0.35f && std::abs(root.x) < 0.45f ? 1u : 0u;
        crossing += std::abs(root.x) > 0.003f && root.x * tip.x < 0.0f ? 1u : 0u;
    }
    // The density falls to 0.35 of the parting's; the side stripe is cut shorter by the bounds on
    // y and z, which only adds to the ratio.
    EXPECT_GT(near, 2.2 * aside) << near << " " << aside;
    EXPECT_GT(crossing, 10u);
    // Hair from further than the 0.03 radii in which chance decides, and the wobble, stays.
    EXPECT_LT(crossing, near);
}

TEST(GrowGroom, HangingHairLeavesTheFaceFree) {
    for (const GrowStyle style : {GrowStyle::kStraight, GrowStyle::kBob, GrowStyle::kWavy,
                                  GrowStyle::kCurly, GrowStyle::kPonytail, GrowStyle::kBraid}) {
        GrowSettings settings = small(style);
        settings.flyaways = 0.0f;
        const Groom groom = *grow_groom(ball(), settings, 4);
        size_t before_eyes = 0;
        for (const glm::vec3& p : groom.points) {
            const bool eyes = std::abs(p.x) < 0.4f * kRadius && p.y < -0.1f * kRadius &&
                              p.y > -0.9f * kRadius && p.z > 0.5f * kRadius;
            before_eyes += eyes ? 1 : 0;
        }
        EXPECT_LT(before_eyes, groom.points.size() / 200) << grow_style_name(style);
    }
}

TEST(GrowGroom, GatheredHairPassesTheBand) {
    const GrowSettings settings = small(GrowStyle::kPonytail);
    const Groom groom = *grow_groom(ball(), settings, 5);
    // All strands come together behind the head before they fall: there is a place that every
    // strand passes within a tail's radius.
    size_t gathered = 0;
    for (size_t s = 0; s < groom.strand_count(); ++s) {
        float lowest = 0.0f;
        for (uint32_t p = groom.strand_begin[s]; p < groom.strand_begin[s + 1]; ++p) {
            lowest = std::min(lowest, groom.points[p].y);
        }
        const glm::vec3 tip = groom.points[groom.strand_begin[s + 1] - 1];
        const bool behind = tip.z < -0.8f * kRadius && std::abs(tip.x) < 0.8f * kRadius;
        gathered += behind && lowest < -2.0f * kRadius ? 1 : 0;
    }
    EXPECT_GT(gathered, groom.strand_count() * 95 / 100);
}

TEST(GrowGroom, NamesTheFieldThatIsWrong) {
    GrowSettings settings = preset(GrowStyle::kBob);
    settings.length = -1.0f;
    const auto negative = grow_groom(ball(), settings, 1);
    ASSERT_FALSE(negative);
    EXPECT_EQ(negative.error().where, "length");
    settings = preset(GrowStyle::kBob);
    settings.frizz = std::nanf("");
    EXPECT_FALSE(grow_groom(ball(), settings, 1));
    settings = preset(GrowStyle::kBob);
    settings.points = 1;
    EXPECT_EQ(grow_groom(ball(), settings, 1).error().where, "points");
    GrowSurface bald = ball();
    std::ranges::fill(bald.density, 0.0f);
    EXPECT_EQ(grow_groom(bald, preset(GrowStyle::kBob), 1).error().where, "surface");
    EXPECT_FALSE(grow_style("mullet"));
}

TEST(GrowGroom, SmallestAndOddestSettingsGrow) {
    for (size_t style = 0; style < grow_style_names().size(); ++style) {
        GrowSettings settings = preset(static_cast<GrowStyle>(style));
        settings.count = 1;
        settings.points = 2;
        settings.guides = 1;
        auto one = grow_groom(ball(), settings, 1);
        ASSERT_TRUE(one) << one.error().message();
        EXPECT_EQ(one->points.size(), 2u);
        settings = preset(static_cast<GrowStyle>(style));
        settings.count = 30;
        settings.guides = 8;
        for (const GrowField& field : grow_fields()) settings.*field.value = field.high;
        settings.length = 0.5f;
        Groom most = *grow_groom(ball(), settings, 1);
        EXPECT_EQ(repair(most).non_finite_strands, 0u) << grow_style_names()[style];
    }
}

}  // namespace
}  // namespace vellus::hair
