#include "modules/hair/environment/ambient.h"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/hair/environment/ambient_depth.h"
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
    for (const float behind : {0.0f, 1.0f, 5.0f, 60.0f}) {
        const auto c =
            shade(glm::vec3(1.0f), {0, 1, 0}, eye, {glm::vec3(0.0f), glm::vec3(0, 0, behind)});
        // The fibre keeps what its residual lobe would send, some percent a scattering: with much
        // hair behind it that adds up as it does in dual scattering.
        EXPECT_GT(c.x, 0.75f) << behind;
        EXPECT_LT(c.x, 1.05f) << behind;
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
    const auto depths = ambient_depths(strands, width);
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
        const double through = 0.4 * std::exp(-0.4 * straight) + 0.6 * std::exp(-0.4 * corner);
        sum += static_cast<double>(depths[i][1]);
        by_hand += -std::log(through) / 0.4;
    }
    ASSERT_GT(by_hand, 0.0);
    // Strands are as far apart as cells are wide: where a ray meets fewer, more light gets through,
    // which takes some percent off the mean.
    EXPECT_NEAR(sum / by_hand, 1.0, 0.05);
}

TEST(AmbientDepth, NothingIsInTheWayOnTheOutside) {
    const StrandData strands = block(1'600);
    const auto depths = ambient_depths(strands, 0.001f);
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

}  // namespace
}  // namespace vellus::hair
