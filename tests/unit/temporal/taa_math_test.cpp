#include <gtest/gtest.h>

#include <cmath>

#include "modules/temporal/jitter.h"
#include "modules/temporal/taa.h"
#include "tests/support/sampling.h"

namespace vellus::temporal {
namespace {

glm::vec3 random_color(test::Random& random) {
    return {random.unit(), random.unit(), random.unit()};
}

TEST(Taa, YCoCgAndBack) {
    for (uint64_t i = 0; i < 10000; ++i) {
        test::Random random(1, i);
        const glm::vec3 c = random_color(random);
        EXPECT_LT(glm::length(glsl::ycocg_to_rgb(glsl::rgb_to_ycocg(c)) - c), 3e-7f);
    }
    // White has no chroma, and Y is its luma.
    EXPECT_EQ(glsl::rgb_to_ycocg(glm::vec3(1.0f)), glm::vec3(1.0f, 0.0f, 0.0f));
}

glsl::TaaBox random_box(test::Random& random) {
    glsl::TaaBox box = glsl::taa_box_start(random_color(random));
    glsl::taa_box_add(box, random_color(random));
    return box;
}

TEST(Taa, ClampEndsAtTheNearestPointOfTheBox) {
    for (uint64_t i = 0; i < 100'000; ++i) {
        test::Random random(2, i);
        const glsl::TaaBox box = random_box(random);
        const glm::vec3 history = random_color(random) * 4.0f - 1.5f;
        const glm::vec3 clamped = glsl::taa_clamp(box, history);
        // No other point of the box is nearer.
        const glm::vec3 other = glm::mix(box.low, box.high, random_color(random));
        EXPECT_LE(glm::distance(clamped, history), glm::distance(other, history) * 1.000001f);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(box.low, clamped)) &&
                    glm::all(glm::lessThanEqual(clamped, box.high)));
    }
}

TEST(Taa, TwoHistoriesNeverMoveApart) {
    // A frame of garbage is forgotten only if this holds in every channel: resolving then shrinks
    // what is left.
    for (uint64_t i = 0; i < 100'000; ++i) {
        test::Random random(4, i);
        glsl::TaaBox box = random_box(random);
        // Grey neighbours: chroma has no room.
        for (const int chroma : {1, 2}) {
            if (random.bits() % 2 != 0) box.high[chroma] = box.low[chroma] + 1e-5f;
        }
        const glm::vec3 history = random_color(random) * 4.0f - 1.5f;
        const glm::vec3 other = history + 1e-3f * (random_color(random) - 0.5f);
        const glm::vec3 apart =
            glm::abs(glsl::taa_clamp(box, history) - glsl::taa_clamp(box, other));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(apart, glm::abs(history - other))));
    }
}

TEST(Taa, ResolveWeighsHighlightsByLuminance) {
    // After Karis 2014: Σ w c / Σ w with w = share / (1 + x + x²/64), x the luma above white; grey
    // of 1 against grey of 5, half and half.
    const glm::vec3 value = glsl::taa_resolve({1, 0, 0}, {5, 0, 0}, 0.5f);
    const double excess = 5.0 - double{glsl::kTaaPlain};
    const double above = 1.0 / (1.0 + excess + excess * excess / 64.0);
    EXPECT_NEAR(value.x, (1.0 + 5.0 * above) / (1.0 + above), 1e-6);
    EXPECT_EQ(glsl::taa_blend({0.5f, 0.5f}, 0.1f), 0.1f);
    EXPECT_EQ(glsl::taa_blend({-0.01f, 0.5f}, 0.1f), 1.0f);
}

TEST(Taa, DitheredStrandsAverageToTheirCoverage) {
    // White drawn in one frame of eight over black, as dither does, is an eighth of white.
    const float blend = 0.06f;
    glm::vec3 history(0.0f);
    double sum = 0.0;
    constexpr int kFrames = 800;
    for (int frame = 0; frame < 2 * kFrames; ++frame) {
        const glm::vec3 drawn(frame % 8 == 0 ? 1.0f : 0.0f);
        history = glsl::taa_resolve(glsl::taa_load(drawn), glsl::rgb_to_ycocg(history), blend);
        if (frame >= kFrames) sum += double{history.x} / kFrames;
    }
    EXPECT_NEAR(sum, 1.0 / 8.0, 1e-4);
}

TEST(Taa, RemembersHairForThreeFramesWithoutAny) {
    float memory = glsl::taa_memory(true, true, 0.0f);
    EXPECT_EQ(memory, 1.0f);
    int frames = 0;
    while ((memory = glsl::taa_memory(false, true, memory)) > 0.0f) ++frames;
    EXPECT_EQ(frames, 3) << "what hair leaves behind must not stay longer";
    EXPECT_EQ(glsl::taa_memory(false, true, 0.0f), 0.0f);
    EXPECT_EQ(glsl::taa_memory(true, false, 1.0f), 0.0f) << "moving hair leaves ghosts";
}

TEST(Taa, CatmullRomKeepsParabolasExactly) {
    for (uint64_t i = 0; i < 1000; ++i) {
        test::Random random(3, i);
        const float position = static_cast<float>(random.range(2.0, 62.0));
        const glsl::TaaCubic c = glsl::taa_catmull_rom(position);
        const auto parabola = [](double u) { return 0.5 * u * u - 3.0 * u + 1.0; };
        double sum = 0.0;
        double value = 0.0;
        for (int k = 0; k < 4; ++k) {
            sum += c.weight[k];
            value += c.weight[k] * parabola(c.first + k + 0.5);
        }
        EXPECT_NEAR(sum, 1.0, 1e-6);
        EXPECT_NEAR(value, parabola(position), 1e-3);
        EXPECT_GE(position, c.first + 1.5);
        EXPECT_LT(position, c.first + 2.5);
    }
}

TEST(Jitter, CoversThePixelEvenly) {
    glm::dvec2 mean(0.0);
    int seen[4][4] = {};
    for (uint32_t frame = 0; frame < 16; ++frame) {
        const glm::vec2 j = halton_jitter(frame);
        EXPECT_LT(std::max(std::abs(j.x), std::abs(j.y)), 0.5f);
        mean += glm::dvec2(j) / 16.0;
        ++seen[static_cast<int>((j.x + 0.5f) * 4.0f)][static_cast<int>((j.y + 0.5f) * 4.0f)];
        EXPECT_EQ(halton_jitter(frame + 16), j);
    }
    EXPECT_LT(glm::length(mean), 0.05);
    int empty = 0;
    for (const auto& row : seen) {
        for (const int count : row) empty += count == 0;
    }
    // 16 Halton points leave 3 of 16 cells empty; 16 random ones 5.7.
    EXPECT_LE(empty, 4);
    EXPECT_DOUBLE_EQ(radical_inverse(6, 2), 0.375);
    EXPECT_DOUBLE_EQ(radical_inverse(5, 3), 2.0 / 3.0 + 1.0 / 9.0);
}

}  // namespace
}  // namespace vellus::temporal
