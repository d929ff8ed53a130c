#include "modules/hair/opacity/dither.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/sampling.h"

namespace vellus::hair {
namespace {

constexpr uint64_t kSamples = 20000;

/// Squared errors of coverage, to be averaged over pixels, strands and alphas.
struct Errors {
    double box = 0.0;       // mean of 16 frames
    double history = 0.0;   // exponential history, blend 0.1
    double standing = 0.0;  // the history's mean over 192 frames: what never averages out
};

/// `covered(frame)` says whether the pixel is covered; `alpha` is what the mean should be.
template <class F>
void add_errors(Errors& errors, double alpha, const F& covered) {
    double box = 0.0;
    double history = alpha;
    double mean = 0.0;
    double square = 0.0;
    constexpr uint32_t kWarmUp = 64;
    constexpr uint32_t kFrames = 192;
    for (uint32_t frame = 0; frame < kWarmUp + kFrames; ++frame) {
        const double x = covered(frame) ? 1.0 : 0.0;
        if (frame < 16) box += x / 16.0;
        history += 0.1 * (x - history);
        if (frame < kWarmUp) continue;
        mean += (history - alpha) / kFrames;
        square += (history - alpha) * (history - alpha) / kFrames;
    }
    errors.box += (box - alpha) * (box - alpha) / kSamples;
    errors.history += square / kSamples;
    errors.standing += mean * mean / kSamples;
}

glm::uvec2 random_pixel(test::Random& random) {
    return {static_cast<uint32_t>(random.bits() % 1920),
            static_cast<uint32_t>(random.bits() % 1080)};
}

TEST(Dither, OneStrandKeepsItsCoverageOverSixteenFrames) {
    Errors errors;
    for (uint64_t i = 0; i < kSamples; ++i) {
        test::Random random(1, i);
        const glm::uvec2 pixel = random_pixel(random);
        const auto strand = glsl::dither_strand(static_cast<uint32_t>(random.bits() % 20000));
        const double alpha = random.unit();
        const auto start = static_cast<uint32_t>(random.bits() % 4096);
        add_errors(errors, alpha, [&](uint32_t frame) {
            return glsl::dither_keeps(static_cast<float>(alpha),
                                      glsl::dither_threshold(strand, pixel, start + frame));
        });
    }
    RecordProperty("box", std::to_string(std::sqrt(errors.box)));
    RecordProperty("history", std::to_string(std::sqrt(errors.history)));
    // White noise would give √(1/6 / 16) = .102 and √(1/6 · .1 / 1.9) = .094; a third of it is
    // asked for.
    EXPECT_LT(std::sqrt(errors.box), 0.042);
    EXPECT_LT(std::sqrt(errors.history), 0.045);
}

TEST(Dither, TwoStrandsCoverLikeIndependentOnes) {
    Errors errors;
    for (uint64_t i = 0; i < kSamples; ++i) {
        test::Random random(2, i);
        const glm::uvec2 pixel = random_pixel(random);
        const auto id = static_cast<uint32_t>(random.bits() % 20000);
        const auto front = glsl::dither_strand(id);
        const auto back = glsl::dither_strand(id + 1 + static_cast<uint32_t>(random.bits() % 100));
        const double a = random.unit();
        const double b = random.unit();
        add_errors(errors, 1.0 - (1.0 - a) * (1.0 - b), [&](uint32_t frame) {
            return glsl::dither_keeps(static_cast<float>(a),
                                      glsl::dither_threshold(front, pixel, frame)) ||
                   glsl::dither_keeps(static_cast<float>(b),
                                      glsl::dither_threshold(back, pixel, frame));
        });
    }
    RecordProperty("box", std::to_string(std::sqrt(errors.box)));
    RecordProperty("history", std::to_string(std::sqrt(errors.history)));
    RecordProperty("standing", std::to_string(std::sqrt(errors.standing)));
    // White noise: .092 and .085. One golden-ratio step for all strands: .082, .083 and a standing
    // error of .075, because a pair never changes its relation.
    EXPECT_LT(std::sqrt(errors.box), 0.065);
    EXPECT_LT(std::sqrt(errors.history), 0.062);
    EXPECT_LT(std::sqrt(errors.standing), 0.035);
}

TEST(Dither, MeanOverPixelsIsAlphaInEveryFrameAndStill) {
    for (uint64_t i = 0; i < 300; ++i) {
        test::Random random(3, i);
        const auto strand = glsl::dither_strand(static_cast<uint32_t>(random.bits()));
        const auto alpha = static_cast<float>(random.unit());
        const auto frame = static_cast<uint32_t>(random.bits());
        const glm::uvec2 corner = random_pixel(random);
        double moving = 0.0;
        double still = 0.0;
        for (uint32_t y = 0; y < 32; ++y) {
            for (uint32_t x = 0; x < 32; ++x) {
                const glm::uvec2 pixel = corner + glm::uvec2(x, y);
                moving += glsl::dither_keeps(alpha, glsl::dither_threshold(strand, pixel, frame));
                still += glsl::dither_keeps(alpha, glsl::dither_threshold_still(strand, pixel));
            }
        }
        // A lattice of 1024 points: discrepancy about log² n / n = .05; white noise would reach .06
        // at 4 σ.
        EXPECT_NEAR(moving / 1024.0, alpha, 0.02);
        EXPECT_NEAR(still / 1024.0, alpha, 0.02);
    }
}

TEST(Dither, ManyLayersStillCover) {
    // dither_still without any history: 12 strands of alpha .3 leave (1 - .3)^12 = 1.4 % of the
    // pixels bare.
    double bare = 0.0;
    for (uint32_t i = 0; i < 100'000; ++i) {
        const glm::uvec2 pixel(i % 400, i / 400);
        bool covered = false;
        for (uint32_t layer = 0; layer < 12 && !covered; ++layer) {
            const auto strand = glsl::dither_strand(layer * 97 + i / 2000);
            covered = glsl::dither_keeps(0.3f, glsl::dither_threshold_still(strand, pixel));
        }
        bare += covered ? 0.0 : 1e-5;
    }
    EXPECT_NEAR(bare, std::pow(0.7, 12), 0.006);
}

TEST(Dither, TransparentNeverAndOpaqueAlways) {
    for (uint64_t i = 0; i < 1'000'000; ++i) {
        test::Random random(4, i);
        const auto strand = glsl::dither_strand(static_cast<uint32_t>(random.bits()));
        const float t = glsl::dither_threshold(strand, random_pixel(random),
                                               static_cast<uint32_t>(random.bits()));
        ASSERT_GE(t, 0.0f);
        ASSERT_FALSE(glsl::dither_keeps(0.0f, t));
        ASSERT_TRUE(glsl::dither_keeps(1.0f, t));
    }
}

TEST(Dither, DrawnWidthTimesAlphaIsTheWidth) {
    for (const float width : {0.0f, 1e-6f, 0.02f, 0.5f, 1.0f, 3.7f}) {
        EXPECT_GE(glsl::strand_drawn_width(width), 1.0f);
        EXPECT_FLOAT_EQ(glsl::strand_drawn_width(width) * glsl::strand_alpha(width), width);
    }
}

}  // namespace
}  // namespace vellus::hair
