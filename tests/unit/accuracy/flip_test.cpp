#include <gtest/gtest.h>

#include "game_demo/tools/accuracy/flip.h"
#include "tests/support/sampling.h"

namespace vellus::demo {
namespace {

constexpr glm::uvec2 kSize{24, 20};

std::vector<glm::vec3> plain(const glm::vec3& colour) {
    return std::vector<glm::vec3>(size_t{kSize.x} * kSize.y, colour);
}

std::vector<glm::vec3> noise(uint64_t seed) {
    std::vector<glm::vec3> picture;
    for (uint64_t i = 0; i < uint64_t{kSize.x} * kSize.y; ++i) {
        test::Random random(seed, i);
        picture.emplace_back(random.unit(), random.unit(), random.unit());
    }
    return picture;
}

void expect_all(const std::vector<float>& errors, float value, float tolerance) {
    for (const float error : errors) ASSERT_NEAR(error, value, tolerance);
}

TEST(Flip, IdenticalPicturesDoNotDiffer) {
    expect_all(flip(noise(1), noise(1), kSize), 0.0f, 0.0f);
}

// By hand: HyAB of black and white is 100, 100^.7 = 25.12. Of green and blue, the farthest apart,
// it is 308.6 (Hunt-adjusted Lab 87.7, -75.6, 73.0 and 32.3, 25.6, -34.8: 55.4 + 147.9 = 203.3),
// 203.3^.7 = 41.27; knee .4 * 41.27 = 16.51; .95 + (25.12 - 16.51) / (41.27 - 16.51) * .05 = .9674.
TEST(Flip, BlackAgainstWhiteIsNearlyOne) {
    expect_all(flip(plain(glm::vec3(0)), plain(glm::vec3(1)), kSize), 0.9674f, 0.001f);
}

TEST(Flip, GreenAgainstBlueIsTheMost) {
    expect_all(flip(plain({0, 1, 0}), plain({0, 0, 1}), kSize), 1.0f, 1e-4f);
}

TEST(Flip, IsSymmetricAndBetweenZeroAndOne) {
    const auto forth = flip(noise(1), noise(2), kSize);
    const auto back = flip(noise(2), noise(1), kSize);
    for (size_t i = 0; i < forth.size(); ++i) {
        EXPECT_EQ(forth[i], back[i]);
        EXPECT_GT(forth[i], 0.0f);
        EXPECT_LE(forth[i], 1.0f);
    }
}

TEST(Flip, AStrongerLineIsSeenMoreAndNotFromFarOff) {
    float last = 0.0f;
    for (const float contrast : {0.05f, 0.1f, 0.2f, 0.4f}) {
        auto line = plain(glm::vec3(0.4f));
        for (uint32_t y = 0; y < kSize.y; ++y) line[y * kSize.x + 6] += contrast;
        // At 20 pixels a degree its filters reach three or four pixels.
        const auto errors = flip(line, plain(glm::vec3(0.4f)), kSize, 20.0);
        EXPECT_GT(errors[10 * kSize.x + 6], last);
        EXPECT_EQ(errors[10 * kSize.x + 20], 0.0f);
        last = errors[10 * kSize.x + 6];
    }
}

}  // namespace
}  // namespace vellus::demo
