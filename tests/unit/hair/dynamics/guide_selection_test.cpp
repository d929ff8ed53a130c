#include "modules/hair/dynamics/guide_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "shaders/common/portable.h"
#include "tests/unit/hair/dynamics/guide_samples.h"

namespace vellus::hair {
namespace {

/// The shader's transfer over turns held here.
struct Transfer {
    std::vector<glm::vec4> turns;
    uint32_t per_guide = 0;
    using vec3 = glm::vec3;
    using vec4 = glm::vec4;
    using uvec3 = glm::uvec3;
    using uint = glm::uint;
    static float floor(float x) { return std::floor(x); }
    static float clamp(float x, float a, float b) { return glm::clamp(x, a, b); }
    template <class T>
    static T max(T a, T b) {
        return std::max(a, b);
    }
    template <class T>
    static T min(T a, T b) {
        return std::min(a, b);
    }
    static vec4 mix(vec4 a, vec4 b, float t) { return glm::mix(a, b, t); }
    static float dot(vec4 a, vec4 b) { return glm::dot(a, b); }
    static vec3 cross(vec3 a, vec3 b) { return glm::cross(a, b); }
    static float inversesqrt(float x) { return 1.0f / std::sqrt(x); }
    vec4 guide_turn(uint guide, uint link) const { return turns[guide * per_guide + link]; }
#include "hair/dynamics/transfer.glsl"
};

struct Flat {
    std::vector<glm::vec3> points;
    std::vector<uint32_t> begin{0};
};

Flat flat(const std::vector<test::Strand>& strands) {
    Flat result;
    for (const auto& strand : strands) {
        result.points.insert(result.points.end(), strand.begin(), strand.end());
        result.begin.push_back(static_cast<uint32_t>(result.points.size()));
    }
    return result;
}

TEST(GuideSelection, GuidesAreSpreadAndFollowedByTheirNeighbours) {
    const auto strands = test::sample_hair(2000);
    const Flat groom = flat(strands);
    const GuideSelection chosen = select_guides(groom.points, groom.begin, 80);
    ASSERT_EQ(chosen.guides.size(), 80u);
    EXPECT_EQ(std::set<uint32_t>(chosen.guides.begin(), chosen.guides.end()).size(), 80u);
    ASSERT_EQ(chosen.follow.size(), 2000u);
    // Roots lie on half a sphere of radius 0.09: 80 caps of equal area have a radius of 0.0145.
    double farthest = 0.0;
    for (size_t s = 0; s < 2000; ++s) {
        double nearest = std::numeric_limits<double>::max();
        for (const uint32_t guide : chosen.guides) {
            nearest = std::min(
                nearest, static_cast<double>(glm::distance(strands[s][0], strands[guide][0])));
        }
        farthest = std::max(farthest, nearest);
        const StrandGuides& follow = chosen.follow[s];
        EXPECT_NEAR(follow.weights.x + follow.weights.y + follow.weights.z, 1.0f, 1e-5f);
        EXPECT_GE(follow.weights.x, follow.weights.y);
        for (int k = 0; k < 3; ++k) {
            EXPECT_LT(follow.guides[k], 80u);
            EXPECT_GE(follow.weights[k], 0.0f);
            EXPECT_LE(follow.reach[k], 1.0f);
        }
    }
    EXPECT_LT(farthest, 3.0 * 0.0145);
    for (uint32_t g = 0; g < 80; ++g) {
        EXPECT_EQ(chosen.follow[chosen.guides[g]].guides.x, g) << "a guide follows itself";
        EXPECT_GT(chosen.follow[chosen.guides[g]].weights.x, 0.9f);
    }
    EXPECT_EQ(select_guides(groom.points, groom.begin, 80).guides, chosen.guides);
}

TEST(GuideSelection, FewStrands) {
    EXPECT_TRUE(select_guides({}, {}, 10).guides.empty());
    const Flat one = flat({test::straight({0, 0, 0}, {0, -0.1f, 0}, 2)});
    const GuideSelection chosen = select_guides(one.points, one.begin, 10);
    EXPECT_EQ(chosen.guides.size(), 1u);
    EXPECT_FLOAT_EQ(chosen.follow[0].weights.x, 1.0f);
    EXPECT_EQ(default_guide_count(10), 10u);
    EXPECT_EQ(default_guide_count(24000), 1000u);
    EXPECT_EQ(default_guide_count(10'000'000), 4096u);
}

TEST(Transfer, StrandsTurnWithTheirGuidesAndKeepTheirShape) {
    // All links of all guides turned alike: so is every segment past the first link's middle.
    const glm::dquat q = test::turn_about({1, 2, 3}, 1.1);
    Transfer transfer;
    transfer.per_guide = 15;
    transfer.turns.assign(30, test::to_vec4(q));
    // Half of them with the other sign, which means the same rotation.
    for (size_t i = 0; i < 30; i += 2) transfer.turns[i] = -transfer.turns[i];
    const auto turn =
        transfer.strand_turn({0, 1, 0}, {0.6f, 0.4f, 0.0f}, glm::vec3(1.0f), 0.5f, 15);
    EXPECT_NEAR(std::abs(glm::dot(turn, test::to_vec4(q))), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::length(turn), 1.0f, 1e-6f);
    // At the root nothing is turned yet.
    const auto root =
        transfer.strand_turn({0, 1, 0}, {0.6f, 0.4f, 0.0f}, glm::vec3(1.0f), 0.0f, 15);
    EXPECT_NEAR(std::abs(root.w), 1.0f, 1e-6f);
    // A vector turns as the quaternion says, and keeps its length.
    const glm::vec3 v(0.01f, -0.02f, 0.005f);
    const glm::vec3 turned = transfer.turn_vector(test::to_vec4(q), v);
    EXPECT_LT(glm::distance(turned, glm::vec3(q * glm::dvec3(v))), 1e-8f);
}

TEST(Transfer, TurnsBlendBetweenLinkMiddlesAndGuides) {
    Transfer transfer;
    transfer.per_guide = 4;
    // Guide 0 turns by 0, .2, .4, .6 rad about X; guide 1 not at all.
    for (int i = 0; i < 4; ++i) {
        transfer.turns.push_back(test::to_vec4(test::turn_about({1, 0, 0}, 0.2 * i)));
    }
    transfer.turns.resize(8, test::kNoTurn);
    const auto angle = [&](glm::vec3 weights, float along, float reach = 1.0f) {
        const auto q = transfer.strand_turn({0, 1, 0}, weights, glm::vec3(reach), along, 4);
        return 2.0f * std::atan2(q.x, q.w);
    };
    EXPECT_NEAR(angle({1, 0, 0}, 0.375f), 0.2f, 1e-5f);      // middle of the second link
    EXPECT_NEAR(angle({1, 0, 0}, 0.5f), 0.3f, 1e-3f);        // halfway to the third's
    EXPECT_NEAR(angle({1, 0, 0}, 1.0f), 0.6f, 1e-5f);        // beyond the last
    EXPECT_NEAR(angle({1, 0, 0}, 1.0f, 0.5f), 0.3f, 1e-3f);  // a strand half as long
    EXPECT_NEAR(angle({0.5f, 0.5f, 0}, 1.0f), 0.3f, 1e-3f);
}

}  // namespace
}  // namespace vellus::hair
