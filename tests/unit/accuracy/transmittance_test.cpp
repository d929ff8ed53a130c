#include "game_demo/tools/accuracy/transmittance.h"

#include <gtest/gtest.h>

namespace vellus::demo {
namespace {

constexpr glm::vec3 kSkin{0.6f, 0.4f, 0.3f};

/// Hair that a light of irradiance 3 reaches in part.
glm::vec3 hair(float share) {
    return {3.0f * share, 0.0f, 3.0f * share};
}

Radiance picture(std::vector<glm::vec3> pixels) {
    return {{static_cast<uint32_t>(pixels.size()), 1}, std::move(pixels)};
}

TEST(AccuracyTransmittance, CountsOnlyFramesThatShowHair) {
    // Always hair; hair in one of two frames, before skin and before nothing; never.
    const std::vector<Radiance> unshadowed = {
        picture({hair(1), hair(1), hair(1), kSkin, glm::vec3(0)}),
        picture({hair(1), kSkin, glm::vec3(0), kSkin, glm::vec3(0)})};
    std::vector<Radiance> frames = {
        picture({hair(0.2f), hair(0.5f), hair(0.0f), 0.5f * kSkin, glm::vec3(0)}),
        picture({hair(0.4f), 0.1f * kSkin, glm::vec3(0), kSkin, glm::vec3(0)})};
    std::vector<float> weight(5, 1.0f);
    to_transmittance(unshadowed, frames, weight);
    const Radiance mean = mean_of(frames);
    EXPECT_FLOAT_EQ(mean.pixels[0].y, 0.3f);
    EXPECT_FLOAT_EQ(mean.pixels[1].y, 0.5f);
    EXPECT_FLOAT_EQ(mean.pixels[2].y, 0.0f);
    EXPECT_EQ(weight, (std::vector<float>{1, 1, 1, 0, 0}));
    // What says nothing of hair does not flicker either.
    EXPECT_EQ(frames[0].pixels[1], frames[1].pixels[1]);
}

}  // namespace
}  // namespace vellus::demo
