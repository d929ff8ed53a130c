#include "modules/hair/environment/ambient.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "modules/hair/environment/ambient_depth.h"
#include "modules/hair/reference/visibility.h"
#include "modules/hair/scattering/fibre.h"

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

glm::vec3 shade(const glm::vec3& color, const glm::vec3& tangent, const glm::vec3& eye,
                const glsl::AmbientDepths& depths) {
    const auto s = surface(color);
    const auto frame = glsl::hair_frame(tangent, eye);
    return glsl::hair_ambient(fibre_of(s), s, frame, tangent, frame.normal, even_light(), depths);
}

TEST(Ambient, WhiteHairUnderAnEvenSkyIsAsBrightAsTheSky) {
    const glm::vec3 eye = glm::normalize(glm::vec3(0.2f, 0.1f, 1.0f));
    const auto at = [&](float before, float behind) {
        return shade(glm::vec3(1.0f), {0, 1, 0}, eye,
                     {glm::vec3(before), glm::vec3(before, before, behind)})
            .x;
    };
    for (const float before : {0.0f, 0.5f, 1.0f}) {
        // The fibre keeps what its residual lobe would send, some percent a scattering.
        for (const float behind : {0.0f, 1.0f}) {
            EXPECT_GT(at(before, behind), 0.75f) << before << " " << behind;
            EXPECT_LT(at(before, behind), 1.05f) << before << " " << behind;
        }
        // Skin behind keeps what reaches it.
        EXPECT_LT(at(before, 60.0f), 0.9f * at(before, 0.0f)) << before;
        EXPECT_GT(at(before, 60.0f), 0.6f) << before;
    }
}

/// Streams in a slab of thin layers, each of which passes and turns what meets it until nothing
/// changes any more.
std::array<double, 2> layered(double forward, double backward, double ahead, double behind,
                              double light_ahead, double light_behind) {
    constexpr int kLayers = 400;
    const double thin = (ahead + behind) / kLayers;
    const double passed = 1.0 - (1.0 - forward) * thin;
    const double turned = backward * thin;
    std::vector<double> in(kLayers + 1, 0.0);   // towards the back, in front of layer i
    std::vector<double> out(kLayers + 1, 0.0);  // towards the front
    in[0] = light_ahead;
    out[kLayers] = light_behind;
    for (int round = 0; round < 200; ++round) {
        for (int i = 0; i < kLayers; ++i) in[i + 1] = passed * in[i] + turned * out[i + 1];
        for (int i = kLayers; i-- > 0;) out[i] = passed * out[i + 1] + turned * in[i];
    }
    const int at = static_cast<int>(std::lround(ahead / thin));
    return {in[at], out[at]};
}

TEST(Ambient, StreamsAreThoseOfManyThinLayers) {
    for (const auto& [forward, backward] : {std::pair(0.6, 0.38), {0.3, 0.1}, {0.05, 0.02}}) {
        for (const auto& [ahead, behind] : {std::pair(0.5, 1.0), {1.0, 0.0}, {0.0, 0.8}}) {
            const glm::vec3 lost(1.0 - forward);
            const glm::vec3 turned(backward);
            const glm::vec3 k = glm::sqrt(lost * lost - turned * turned);
            const auto streams =
                glsl::ambient_streams(lost, turned, k, static_cast<float>(ahead),
                                      static_cast<float>(behind), glm::vec3(1.0f), glm::vec3(0.4f));
            const auto layers = layered(forward, backward, ahead, behind, 1.0, 0.4);
            // Thin layers leave out what happens twice within one.
            EXPECT_NEAR(streams.ahead.x, layers[0], 0.005) << forward << " " << ahead;
            EXPECT_NEAR(streams.behind.x, layers[1], 0.005) << forward << " " << ahead;
        }
    }
}

TEST(Ambient, DeepHairFadesAsItsStreamsDo) {
    const glm::vec3 lost(0.4f);
    const glm::vec3 turned(0.3f);
    const glm::vec3 k = glm::sqrt(lost * lost - turned * turned);
    const auto ahead = [&](float depth) {
        return glsl::ambient_streams(lost, turned, k, depth, depth, glm::vec3(1.0f),
                                     glm::vec3(0.0f))
            .ahead.x;
    };
    for (const float depth : {2.0f, 5.0f}) {
        EXPECT_NEAR(ahead(depth + 1.0f) / ahead(depth), std::exp(-k.x), 1e-5f) << depth;
    }
}

TEST(Ambient, BlackHairLosesLightByItsOpticalDepth) {
    const glm::vec3 eye(0.0f, 0.0f, 1.0f);
    const auto open = shade(glm::vec3(0.0f), {0, 1, 0}, eye, {glm::vec3(0.0f), glm::vec3(0.0f)});
    const auto deep = shade(glm::vec3(0.0f), {0, 1, 0}, eye, {glm::vec3(2.0f), glm::vec3(2.0f)});
    // Only R is left, a few percent of which goes on: e^(-2 (1 - a_f)).
    EXPECT_NEAR(deep.x / open.x, std::exp(-2.0), 0.03);
    EXPECT_GT(open.x, 0.02f);
}

TEST(Ambient, LightFromBelowDoesNotReachHairLitFromBelowThroughHair) {
    glsl::AmbientLight light{};
    light.against[1] = glm::vec3(1.0f);
    const auto s = surface({0.5f, 0.4f, 0.3f});
    const glm::vec3 tangent(1.0f, 0.0f, 0.0f);
    const auto frame = glsl::hair_frame(tangent, {0, 0, 1});
    const auto fibre = fibre_of(s);
    const auto at = [&](float depth) {
        return glsl::hair_ambient(fibre, s, frame, tangent, frame.normal, light,
                                  {glm::vec3(0.0f), glm::vec3(0, depth, 0)});
    };
    EXPECT_GT(at(0.0f).x, 0.1f);
    EXPECT_LT(at(40.0f).x, 0.1f * at(0.0f).x);
    // Light hair passes more of it on than dark, red more than blue.
    EXPECT_GT(at(3.0f).r / at(0.0f).r, at(3.0f).b / at(0.0f).b);
}

TEST(Ambient, CodesHoldDepthsToAFewPercent) {
    for (float depth = 0.02f; depth < 30.0f; depth *= 1.1f) {
        const auto back =
            glsl::ambient_depth(glm::vec3(static_cast<float>(glsl::ambient_code(depth))));
        // Half a step of 254 in d / (d + 4): its slope is 4 / (d + 4)².
        const float step = 0.5f / 254.0f * (depth + 4.0f) * (depth + 4.0f) / 4.0f;
        EXPECT_NEAR(back.x, depth, 1.2f * step) << depth;
    }
    EXPECT_EQ(glsl::ambient_depth(glm::vec3(0.0f)).x, 0.0f);
    EXPECT_EQ(glsl::ambient_depth(glm::vec3(254.0f)).x, glsl::kAmbientMost);
    EXPECT_EQ(glsl::ambient_code(1e30f), 254u);
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
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, width);
    // Across, a metre of the block holds 10,000 · 0.2 m · 0.4 mm / 0.2³ m³ of area.
    const double density = 10'000.0 * 0.2 * static_cast<double>(width) / (0.2 * 0.2 * 0.2);
    double sum = 0.0;
    double by_hand = 0.0;
    for (size_t i = 0; i < depths.size(); ++i) {
        const glm::vec3 p = strands.positions[i];
        if (std::abs(p.x - 0.1f) > 0.01f || std::abs(p.z - 0.1f) > 0.015f) continue;
        const double above = 0.2 - static_cast<double>(p.y);
        if (above > 0.08 || above < 0.03) continue;  // rays leave at the top
        // Straight up, and to the corners: √3 as far, past strands at sin² = 2/3 of their width.
        const double straight = density * above;
        const double corner = 2.0 / std::sqrt(3.0) * straight;
        const double through = 0.4 * std::exp(-0.5 * straight) + 0.6 * std::exp(-0.5 * corner);
        sum += static_cast<double>(depths[i][1]);
        by_hand += -std::log(through) / 0.5;
    }
    ASSERT_GT(by_hand, 0.0);
    // Strands are as far apart as cells are wide: where a ray meets fewer, more light gets through,
    // which takes some percent off the mean.
    EXPECT_NEAR(sum / by_hand, 1.0, 0.05);
}

TEST(AmbientDepth, NothingIsInTheWayOnTheOutside) {
    const StrandData strands = block(1'600);
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, 0.001f);
    double open = 0.0;
    double inward = 0.0;
    int count = 0;
    for (size_t i = 0; i < depths.size(); ++i) {
        const glm::vec3 p = strands.positions[i];
        if (p.y < 0.196f || std::abs(p.x - 0.1f) > 0.01f || std::abs(p.z - 0.1f) > 0.05f) continue;
        open += depths[i][1];
        inward += depths[i][4];
        ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_LT(open / count, 1.0);
    // Straight down nothing gets through; some of the corners' rays leave by the near sides.
    EXPECT_GT(inward / count, 5.0 * open / count);
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
    std::vector<reference::RoundSegment> segments;
    for (size_t i = 0; i < strands.segment_count(); ++i) {
        const uint32_t first = strands.segment_point[i];
        segments.push_back({.a = strands.positions[first],
                            .b = strands.positions[first + 1],
                            .radius_a = kWidth / 2,
                            .radius_b = kWidth / 2,
                            .opacity = 0.5,
                            .strand = strands.segment_strand[i]});
    }
    const auto depths = ambient_depths(strands.positions, strands.strand_begin, kWidth);
    // Along the strands, and across them.
    std::array<double, 2> difference{};
    std::array<double, 2> bias{};
    std::array<double, 2> count{};
    for (size_t i = 0; i < depths.size(); i += 517) {
        const auto rays = brute_force(segments, glm::dvec3(strands.positions[i]));
        for (size_t k = 0; k < 6; ++k) {
            const double through = std::exp(-0.5 * static_cast<double>(depths[i][k]));
            const size_t across = k % 3 == 0 ? 0 : 1;
            difference[across] += std::abs(through - rays[k]);
            bias[across] += through - rays[k];
            count[across] += 1.0;
        }
    }
    ASSERT_GE(count[0], 28.0);
    // Cells of 2 mm that get coarser with distance.
    EXPECT_LT(difference[1] / count[1], 0.06);
    EXPECT_NEAR(bias[1] / count[1], 0.0, 0.03);
    // Fourteen directions stand for the sphere: straight along the strands, one meets none of them,
    // where its neighbours do.
    EXPECT_LT(difference[0] / count[0], 0.17);
}

}  // namespace
}  // namespace vellus::hair
