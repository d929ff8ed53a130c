#include "modules/hair/environment/ambient.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "modules/hair/environment/ambient_depth.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/reference/visibility.h"
#include "modules/hair/scattering/fibre.h"
#include "tests/support/round_segments.h"

namespace vellus::hair {
namespace {

glsl::HairSurface surface(const glm::vec3& color) {
    return {color, 0.5f, 0.3f, 1.0f, 0.035f};
}

glsl::HairFibre fibre_of(const glsl::HairSurface& s) {
    glsl::HairFibre fibre{};
    fit_azimuthal({}, fibre);
    set_longitudinal(s.roughness, s.shift, fibre);
    return fibre;
}

glsl::AmbientLight even_light() {
    glsl::AmbientLight light;
    for (int i = 0; i < 3; ++i) light.along[i] = light.against[i] = glm::vec3(1.0f);
    return light;
}

glsl::Sh9 even_sky() {
    glsl::Sh9 sky{};
    sky.c[0] = glm::vec3(1.0f);
    return sky;
}

glsl::AmbientDepths depths_of(const glm::vec3& along, const glm::vec3& against) {
    return {along, against, glm::vec3(1.0f), glm::vec3(1.0f)};
}

glm::vec3 shade(const glm::vec3& color, const glm::vec3& tangent, const glm::vec3& eye,
                const glsl::AmbientDepths& depths) {
    const auto s = surface(color);
    const auto frame = glsl::hair_frame(tangent, eye);
    return glsl::hair_ambient(fibre_of(s), s, frame, tangent, glm::mat3(1.0f), even_sky(),
                              even_light(), depths);
}

TEST(Ambient, WhiteHairUnderAnEvenSkyIsAsBrightAsTheSky) {
    const glm::vec3 eye = glm::normalize(glm::vec3(0.2f, 0.1f, 1.0f));
    const auto at = [&](float before, float behind, float open) {
        auto depths = depths_of(glm::vec3(before), glm::vec3(before, before, behind));
        depths.open_against.z = open;
        return shade(glm::vec3(1.0f), {0, 1, 0}, eye, depths).x;
    };
    for (const float before : {0.0f, 0.5f, 1.0f, 5.0f}) {
        for (const float behind : {0.0f, 1.0f, 20.0f}) {
            // What is passed on and turned back is cut at 0.9999 of what comes, at each turning.
            EXPECT_NEAR(at(before, behind, 1.0f), 1.0f, 0.005f) << before << " " << behind;
        }
        // Skin behind keeps what reaches it.
        EXPECT_LT(at(before, 0.0f, 0.0f), 0.8f) << before;
        EXPECT_GT(at(before, 0.0f, 0.0f), 0.2f) << before;
    }
}

TEST(Ambient, TheLevelIsWhatAllTurningsAddUpTo) {
    glsl::AmbientLight light{};
    light.along[0] = {1.0f, 0.4f, 0.1f};
    light.along[1] = glm::vec3(3.0f);
    light.against[2] = glm::vec3(0.5f);
    glsl::AmbientDepths depths = depths_of({0.3f, 2.0f, 1.0f}, {4.0f, 0.0f, 0.7f});
    depths.open_along.z = 0.4f;
    depths.open_against.x = 0.0f;
    const glm::vec3 lost{0.32f, 0.5f, 0.9f};
    const glm::vec3 back{0.3f, 0.2f, 0.1f};
    const auto arrival = glsl::ambient_arrival(lost, back, light, depths);
    for (int channel = 0; channel < 3; ++channel) {
        const double loss = lost[channel];
        const double turned = static_cast<double>(back[channel]) / loss;
        const auto way = [&](int i, bool along) {
            const double hair = along ? depths.along[i] : depths.against[i];
            const double open = along ? depths.open_along[i] : depths.open_against[i];
            const double through = std::exp(-loss * hair);
            return std::pair(through * open,
                             turned * (1.0 - through) +
                                 through * (1.0 - open) * static_cast<double>(glsl::kAmbientSkin));
        };
        // Turning by turning.
        double level = 0.0;
        for (int turning = 0; turning < 500; ++turning) {
            double sum = 0.0;
            for (int i = 0; i < 3; ++i) {
                sum += way(i, true).first * static_cast<double>(light.along[i][channel]) +
                       way(i, true).second * level;
                sum += way(i, false).first * static_cast<double>(light.against[i][channel]) +
                       way(i, false).second * level;
            }
            level = sum / 6.0;
        }
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(arrival.sky.along[i][channel], way(i, true).first, 1e-5) << i;
            EXPECT_NEAR(arrival.sky.against[i][channel], way(i, false).first, 1e-5) << i;
            EXPECT_NEAR(arrival.around.along[i][channel], way(i, true).second * level, 1e-5) << i;
            EXPECT_NEAR(arrival.around.against[i][channel], way(i, false).second * level, 1e-5)
                << i;
        }
    }
}

TEST(Ambient, BlackHairLosesLightByItsOpticalDepth) {
    const glm::vec3 eye(0.0f, 0.0f, 1.0f);
    const auto at = [&](float depth) {
        return shade(glm::vec3(0.0f), {0, 1, 0}, eye, depths_of(glm::vec3(depth), glm::vec3(depth)))
            .x;
    };
    // Only R is left, a few percent of which goes on: e^(-2 (1 - a_f)).
    EXPECT_NEAR(at(2.0f) / at(0.0f), std::exp(-2.0), 0.03);
    EXPECT_GT(at(0.0f), 0.02f);
}

TEST(Ambient, TheSkyIsThatOfALobe) {
    // 1 + 0.5 y + 0.3 (3y² - 1) as irradiance/π: bands 1 and 2 have 2/3 and 1/4.
    glsl::Sh9 sky = even_sky();
    sky.c[2] = glm::vec3(0.5f * 2.0f / 3.0f);
    sky.c[6] = glm::vec3(0.3f / 4.0f);
    for (const glm::vec3 direction : {glm::vec3(0, 1, 0), {0.6f, -0.8f, 0}, {0.48f, 0.6f, 0.64f}}) {
        const double y = direction.y;
        const double variance = 0.35 * 0.35;
        const double by_hand = 1.0 + 0.5 * y * std::exp(-variance) +
                               0.3 * (3.0 * y * y - 1.0) * std::exp(-3.0 * variance);
        EXPECT_NEAR(glsl::ambient_sky(sky, direction).x, by_hand, 1e-3) << y;
    }
}

TEST(Ambient, CodesHoldDepthsAndOpenness) {
    for (int i = 0; i < 60; ++i) {
        const float depth = 0.1f * std::pow(1.1f, static_cast<float>(i));
        const uint32_t code = glsl::ambient_code(depth, 0.4f);
        // Three to a word: this one between others that are full.
        const uint32_t full = glsl::ambient_code(1e30f, 1.0f);
        const uint32_t word = full | code << 10 | full << 20;
        const glm::vec3 back = glsl::ambient_depth(glsl::ambient_steps(word));
        // Half a step of 62 in d / (d + 4): its slope is 4 / (d + 4)².
        const float step = 0.5f / 62.0f * (depth + 4.0f) * (depth + 4.0f) / 4.0f;
        EXPECT_NEAR(back.y, depth, 1.4f * step) << depth;
        EXPECT_EQ(back.x, glsl::kAmbientMost);
        EXPECT_EQ(back.z, glsl::kAmbientMost);
        EXPECT_NEAR(glsl::ambient_open(word).y, 0.4f, 0.5f / 15.0f);
        EXPECT_EQ(glsl::ambient_open(word).x, 1.0f);
    }
    EXPECT_EQ(glsl::ambient_depth(glm::vec3(0.0f)).x, 0.0f);
    EXPECT_EQ(glsl::ambient_code(1e30f, 1.0f), 1022u);
}

/// Strands along x that fill a block of 20 x 20 x 20 cm evenly, by the R2 sequence.
StrandData block(int count) {
    Groom groom;
    for (int strand = 0; strand < count; ++strand) {
        const double y = std::fmod(0.7548776662 * strand, 1.0);
        const double z = std::fmod(0.5698402910 * strand, 1.0);
        for (int i = 0; i <= 4; ++i) groom.points.emplace_back(0.05 * i, 0.2 * y, 0.2 * z);
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return prepare_strands(groom, glm::dmat4(1.0), 0.001f);
}

TEST(AmbientDepth, CountsTheStrandsOfABlock) {
    const StrandData strands = block(10'000);
    const float width = 0.0004f;
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, {width});
    // Across, a metre of the block holds 10,000 · 0.2 m · 0.4 mm / 0.2³ m³ of area.
    const double density = 10'000.0 * 0.2 * static_cast<double>(width) / (0.2 * 0.2 * 0.2);
    double sum = 0.0;
    double by_hand = 0.0;
    for (size_t i = 0; i < depths.size(); ++i) {
        const glm::vec3 p = strands.positions[i];
        if (std::abs(p.x - 0.1f) > 0.01f || std::abs(p.z - 0.1f) > 0.015f) continue;
        const double above = 0.2 - static_cast<double>(p.y);
        if (above > 0.08 || above < 0.03) continue;  // rays leave at the top
        // Straight up, and to the corners: √3 as far, past strands at a sine of √(2/3).
        const double straight = density * above;
        const double corner = std::sqrt(2.0) * straight;
        const double through = 0.4 * std::exp(-0.5 * straight) + 0.6 * std::exp(-0.5 * corner);
        sum += static_cast<double>(depths[i].hair[1]);
        by_hand += -std::log(through) / 0.5;
    }
    ASSERT_GT(by_hand, 0.0);
    // Strands are as far apart as cells are wide: where a ray meets fewer, more light gets through,
    // which takes some percent off the mean.
    EXPECT_NEAR(sum / by_hand, 1.0, 0.05);
}

TEST(AmbientDepth, NothingIsInTheWayOnTheOutside) {
    const StrandData strands = block(1'600);
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, {0.001f});
    double open = 0.0;
    double inward = 0.0;
    int count = 0;
    for (size_t i = 0; i < depths.size(); ++i) {
        const glm::vec3 p = strands.positions[i];
        if (p.y < 0.196f || std::abs(p.x - 0.1f) > 0.01f || std::abs(p.z - 0.1f) > 0.05f) continue;
        open += depths[i].hair[1];
        inward += depths[i].hair[4];
        ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_LT(open / count, 1.0);
    // Straight down nothing gets through; some of the corners' rays leave by the near sides.
    EXPECT_GT(inward / count, 5.0 * open / count);
}

TEST(AmbientDepth, StrandsThatTaperStopMostNearTheirRoots) {
    const StrandData strands = block(4'000);
    const auto even = ambient_depths(strands.positions, strands.strand_begin, {0.0005f, 1.0f});
    const auto pointed = ambient_depths(strands.positions, strands.strand_begin, {0.001f, 0.0f});
    std::array<double, 5> ratio{};
    std::array<double, 5> count{};
    for (size_t i = 0; i < even.size(); ++i) {
        const glm::vec3 p = strands.positions[i];
        if (std::abs(p.y - 0.1f) > 0.03f || std::abs(p.z - 0.1f) > 0.03f) continue;
        ratio[i % 5] += static_cast<double>(pointed[i].hair[1] / even[i].hair[1]);
        count[i % 5] += 1.0;
    }
    // As wide on average, twice that at the roots (x = 0), nothing at the tips. Slanting
    // directions, with 0.6 of the weight, see up to half of the strand, and most light takes the
    // thinner way.
    EXPECT_GT(ratio[0] / count[0], 1.2);
    EXPECT_NEAR(ratio[2] / count[2], 1.0, 0.2);
    EXPECT_LT(ratio[4] / count[4], 0.5);
}

TEST(AmbientDepth, RootsAroundABallHideWhatLiesBehindIt) {
    Groom groom;
    constexpr int kStrands = 3'000;
    for (int strand = 0; strand < kStrands; ++strand) {
        const double y = 1.0 - (2.0 * strand + 1.0) / kStrands;
        const double turn = 2.39996322972865332 * strand;
        const double r = std::sqrt(1.0 - y * y);
        const glm::vec3 out(r * std::cos(turn), y, r * std::sin(turn));
        for (int i = 0; i <= 4; ++i) groom.points.push_back((0.1f + 0.01f * i) * out);
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    const StrandData strands = prepare_strands(groom, glm::dmat4(1.0), 0.0001f);
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, {0.0001f});
    for (size_t i = 0; i < depths.size(); ++i) {
        const glm::vec3 p = strands.positions[i];
        for (size_t k = 0; k < 3; ++k) {
            const float at = p[static_cast<int>(k)];
            // Nearly on an axis: out there is sky, and behind it the ball.
            if (std::abs(at) < 0.99f * glm::length(p)) continue;
            EXPECT_EQ(depths[i].open[at > 0.0f ? k : k + 3], 1.0f) << i;
            // From the tips the corners' rays, 55° off, pass it by.
            const float behind = depths[i].open[at > 0.0f ? k + 3 : k];
            EXPECT_LT(behind, i % 5 == 0 ? 0.05f : 0.7f) << i;
        }
    }
}

/// Means of (1 - 0.5)^n over directions, n the strands that a ray meets, weighted by squared
/// cosines of the directions on the side of each axis.
std::array<double, 6> brute_force(const std::vector<reference::RoundSegment>& segments,
                                  const glm::dvec3& p) {
    constexpr int kRays = 600;
    std::array<double, 6> sum{};
    std::array<double, 6> weight{};
    for (int i = 0; i < kRays; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kRays;
        const double turn = 2.39996322972865332 * i;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 d(r * std::cos(turn), r * std::sin(turn), z);
        const double through = reference::transmittance_along(segments, p, d).at(1e9);
        for (int k = 0; k < 3; ++k) {
            const auto axis = static_cast<size_t>(d[k] > 0.0 ? k : k + 3);
            sum[axis] += d[k] * d[k] * through;
            weight[axis] += d[k] * d[k];
        }
    }
    for (size_t k = 0; k < 6; ++k) sum[k] /= weight[k];
    return sum;
}

TEST(AmbientDepth, IsWhatRaysThroughTheStrandsFind) {
    // Where strands lie by chance, transmittance falls as the exponential says.
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0f, 0.2f);
    Groom groom;
    for (int strand = 0; strand < 1'500; ++strand) {
        const glm::vec3 root(0.0f, unit(random), unit(random));
        for (int i = 0; i <= 4; ++i) groom.points.push_back(root + glm::vec3(0.05f * i, 0, 0));
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    constexpr float kWidth = 0.001f;
    const StrandData strands = prepare_strands(groom, glm::dmat4(1.0), kWidth);
    const auto segments = test::round_segments(strands, kWidth, 0.5);
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, {kWidth});
    // Along the strands, and across them.
    std::array<double, 2> difference{};
    std::array<double, 2> bias{};
    std::array<double, 2> count{};
    for (size_t i = 0; i < depths.size(); i += 517) {
        const auto rays = brute_force(segments, glm::dvec3(strands.positions[i]));
        for (size_t k = 0; k < 6; ++k) {
            const double through = std::exp(-0.5 * static_cast<double>(depths[i].hair[k]));
            const size_t across = k % 3 == 0 ? 0 : 1;
            difference[across] += std::abs(through - rays[k]);
            bias[across] += through - rays[k];
            count[across] += 1.0;
        }
    }
    ASSERT_GE(count[0], 28.0);
    // Cells of 2 mm that get coarser with distance, and fourteen directions, none of which lies
    // near enough to the strands to pass along them.
    EXPECT_LT(difference[1] / count[1], 0.06);
    EXPECT_NEAR(bias[1] / count[1], 0.0, 0.05);
    // Fourteen directions stand for the sphere: straight along the strands, one meets none of them,
    // where its neighbours do.
    EXPECT_LT(difference[0] / count[0], 0.17);
}

}  // namespace
}  // namespace vellus::hair
