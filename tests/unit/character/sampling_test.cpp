#include "modules/character/sampling.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/character/brute_force.h"

namespace vellus::character {
namespace {

using asset::AnimationChannel;
using asset::AnimationPath;
using asset::Interpolation;

AnimationChannel random_channel(std::mt19937& random, AnimationPath path, Interpolation how) {
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    AnimationChannel channel;
    channel.path = path;
    channel.interpolation = how;
    channel.width = path == AnimationPath::kRotation ? 4 : path == AnimationPath::kWeights ? 6 : 3;
    const size_t keys = 1 + random() % 9;
    float time = 0.5f * unit(random);
    for (size_t k = 0; k < keys; ++k) {
        channel.times.push_back(time += 0.01f + std::abs(unit(random)));
        const int parts = how == Interpolation::kCubicSpline ? 3 : 1;
        for (int part = 0; part < parts; ++part) {
            glm::quat q(unit(random), unit(random), unit(random), unit(random));
            q = glm::normalize(q);
            const bool rotation = path == AnimationPath::kRotation && (parts == 1 || part == 1);
            for (uint32_t i = 0; i < channel.width; ++i) {
                const float xyzw[] = {q.x, q.y, q.z, q.w};
                channel.values.push_back(rotation ? xyzw[i] : unit(random));
            }
        }
    }
    return channel;
}

TEST(Sampling, AgreesWithBruteForceOnEveryPathAndInterpolation) {
    std::mt19937 random(11);
    for (const auto how :
         {Interpolation::kLinear, Interpolation::kStep, Interpolation::kCubicSpline}) {
        for (const auto path : {AnimationPath::kTranslation, AnimationPath::kRotation,
                                AnimationPath::kScale, AnimationPath::kWeights}) {
            for (int i = 0; i < 200; ++i) {
                const AnimationChannel channel = random_channel(random, path, how);
                std::uniform_real_distribution<double> when(-1.0, 8.0);
                for (int k = 0; k < 20; ++k) {
                    double time = when(random);
                    if (k < 4) time = channel.times[random() % channel.times.size()];  // on a key
                    std::vector<float> out(channel.width);
                    sample(channel, time, out);
                    const auto expected = test::brute_force(channel, time);
                    for (uint32_t c = 0; c < channel.width; ++c) {
                        // Values near 1 in float; the rest is double on both sides.
                        ASSERT_NEAR(out[c], expected[c], 2e-6)
                            << "path " << int(path) << " how " << int(how) << " time " << time;
                    }
                }
            }
        }
    }
}

TEST(Sampling, ValuesHoldBeforeTheFirstAndAfterTheLastKey) {
    AnimationChannel channel;
    channel.times = {0.5f, 1.0f};
    channel.values = {1, 2, 3, 4, 5, 6};
    std::array<float, 3> out{};
    for (const double time : {-1e9, 0.0, 0.5}) {
        sample(channel, time, out);
        EXPECT_EQ(out, (std::array<float, 3>{1, 2, 3})) << time;
    }
    for (const double time : {1.0, 7.0, 1e9}) {
        sample(channel, time, out);
        EXPECT_EQ(out, (std::array<float, 3>{4, 5, 6})) << time;
    }
}

TEST(Sampling, RotationsTakeTheShorterArc) {
    AnimationChannel channel;
    channel.path = AnimationPath::kRotation;
    channel.width = 4;
    channel.times = {0.0f, 1.0f};
    const glm::quat a = glm::angleAxis(0.2f, glm::vec3(0, 1, 0));
    const glm::quat b = -glm::angleAxis(0.6f, glm::vec3(0, 1, 0));
    channel.values = {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w};
    std::array<float, 4> out{};
    sample(channel, 0.5, out);
    const glm::quat middle(out[3], out[0], out[1], out[2]);
    EXPECT_NEAR(std::abs(glm::dot(middle, glm::angleAxis(0.4f, glm::vec3(0, 1, 0)))), 1.0f, 1e-6f);
}

TEST(Sampling, DegenerateChannelsStayFinite) {
    AnimationChannel channel;
    std::array<float, 4> out{7, 7, 7, 7};
    sample(channel, 1.0, out);
    EXPECT_EQ(out[0], 7.0f) << "no key, nothing written";
    channel.path = AnimationPath::kRotation;
    channel.width = 4;
    channel.times = {0.0f, 0.0f, 1.0f};
    channel.values.assign(12, 0.0f);  // no direction at all
    for (const double time : {-1.0, 0.0, 0.5, 2.0}) {
        sample(channel, time, out);
        EXPECT_EQ(out, (std::array<float, 4>{0, 0, 0, 1})) << time;
    }
}

TEST(Sampling, ClipTimeWrapsOrClamps) {
    EXPECT_DOUBLE_EQ(clip_time(2.5, 1.0, true), 0.5);
    EXPECT_DOUBLE_EQ(clip_time(-0.25, 1.0, true), 0.75);
    EXPECT_DOUBLE_EQ(clip_time(2.5, 1.0, false), 1.0);
    EXPECT_DOUBLE_EQ(clip_time(-2.5, 1.0, false), 0.0);
    EXPECT_DOUBLE_EQ(clip_time(3.0, 0.0, true), 0.0);
}

}  // namespace
}  // namespace vellus::character
