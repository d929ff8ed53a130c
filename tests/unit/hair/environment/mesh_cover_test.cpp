#include "modules/hair/environment/mesh_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "modules/hair/environment/cover.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/reference/visibility.h"
#include "tests/support/round_segments.h"

namespace vellus::hair {
namespace {

/// What arrives below a slab by Schuster's two streams, integrated from its lower side up.
double through_slab(double forward, double backward, double depth) {
    constexpr int kSteps = 4000;
    glm::dvec2 streams(1.0, 0.0);  // down, up; nothing comes from below
    const double h = depth / kSteps;
    const auto slope = [&](const glm::dvec2& s) {
        // Towards the light: what went down was more, what goes up becomes more.
        return glm::dvec2((1.0 - forward) * s.x - backward * s.y,
                          -(1.0 - forward) * s.y + backward * s.x);
    };
    for (int i = 0; i < kSteps; ++i) {
        const glm::dvec2 half = streams + 0.5 * h * slope(streams);
        streams += h * slope(half);
    }
    return 1.0 / streams.x;
}

TEST(CoverShare, IsWhatTwoStreamsLeave) {
    for (const auto& [f, b] : {std::pair(0.02, 0.01), {0.3, 0.2}, {0.5, 0.45}, {0.6, 0.3999}}) {
        for (const double depth : {0.0, 0.3, 2.0, 8.0}) {
            const double exact = through_slab(f, b, depth);
            for (const double open : {0.0, 0.4, 1.0}) {
                const auto share = glsl::cover_share(
                    static_cast<float>(open), static_cast<float>(depth),
                    glm::vec3(static_cast<float>(f)), glm::vec3(static_cast<float>(b)));
                EXPECT_NEAR(share.x, open + (1.0 - open) * exact, 1e-3) << f << " " << depth;
            }
        }
    }
    // Nothing in the way: to the bit.
    EXPECT_EQ(glsl::cover_share(1.0f, 0.0f, glm::vec3(0.4f), glm::vec3(0.3f)), glm::vec3(1.0f));
}

TEST(FitSky, HoldsTheMeansItWasMadeOf) {
    for (const double open : {0.0, 0.1, 0.5, 0.9}) {
        for (const double depth : {0.05, 0.7, 3.0, 20.0}) {
            const auto mean = [&](double lost) {
                return open + (1.0 - open) * std::exp(-lost * depth);
            };
            const SkyAtVertex sky =
                fit_sky(static_cast<float>(mean(0.3)), static_cast<float>(mean(1.0)));
            for (const double lost : {0.3, 0.6, 1.0}) {
                const auto fitted = static_cast<double>(sky.open) +
                                    (1.0 - static_cast<double>(sky.open)) *
                                        std::exp(-lost * static_cast<double>(sky.depth));
                EXPECT_NEAR(fitted, mean(lost), 2e-3) << open << " " << depth << " " << lost;
            }
        }
    }
    EXPECT_EQ(fit_sky(1.0f, 1.0f).open, 1.0f);
    EXPECT_EQ(fit_sky(1.0f, 1.0f).depth, 0.0f);
}

constexpr float kWidth = 0.001f;

/// Strands along x that lie by chance in 20 x 5 x 20 cm, 1 cm above the plane y = 0.
StrandData slab(int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    Groom groom;
    for (int strand = 0; strand < count; ++strand) {
        const glm::vec3 root(-0.1f, 0.01f + 0.05f * unit(random), 0.2f * unit(random) - 0.1f);
        for (int i = 0; i <= 4; ++i) groom.points.push_back(root + glm::vec3(0.05f * i, 0, 0));
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return prepare_strands(groom, glm::dmat4(1.0), kWidth);
}

CoveringGroom over_plane(const StrandData& strands, const glm::mat4& to_groom = glm::mat4(1.0f)) {
    return {ambient_volume({strands.positions, strands.strand_begin}, StrandTaper{kWidth}),
            to_groom};
}

/// Mean transmittance of the hemisphere around +y, by cosine, of strands that let half pass of what
/// meets them; and the mean direction of what passes.
struct Seen {
    double share = 0.0;
    glm::dvec3 from{0.0};
};

Seen brute_force(const StrandData& strands, const glm::dvec3& p, double opacity) {
    const auto segments = test::round_segments(strands, kWidth, opacity);
    constexpr int kRays = 2000;
    Seen seen;
    for (int i = 0; i < kRays; ++i) {
        const double up = std::sqrt((i + 0.5) / kRays);  // by cosine
        const double turn = 2.39996322972865332 * i;
        const double r = std::sqrt(1.0 - up * up);
        const glm::dvec3 d(r * std::cos(turn), up, r * std::sin(turn));
        const double through = reference::transmittance_along(segments, p, d).at(1e9);
        seen.share += through / kRays;
        seen.from += through * d;
    }
    seen.from = glm::normalize(seen.from);
    return seen;
}

const std::vector<glm::vec3> kPlaces = {{0, 0, 0},        {0.06f, 0, -0.05f}, {0, 0, 0.1f},
                                        {0.1f, 0, 0},     {0, 0, 0.14f},      {0.17f, 0, 0},
                                        {0.1f, 0, 0.15f}, {-0.03f, 0, 0.3f}};

TEST(MeshCover, IsWhatRaysThroughTheStrandsFind) {
    const StrandData strands = slab(500);
    std::vector<CoveringGroom> grooms = {over_plane(strands)};
    const std::vector<glm::vec3> normals(kPlaces.size(), glm::vec3(0, 2, 0));
    const MeshCover cover = mesh_cover({kPlaces, normals, {}}, grooms);
    double least = 1.0;
    for (size_t i = 0; i < kPlaces.size(); ++i) {
        const SkyAtVertex& sky = cover.vertices[i];
        for (const double opacity : {0.3, 0.6, 1.0}) {
            const Seen rays = brute_force(strands, glm::dvec3(kPlaces[i]), opacity);
            const auto share = static_cast<double>(sky.open) +
                               (1.0 - static_cast<double>(sky.open)) *
                                   std::exp(-opacity * static_cast<double>(sky.depth));
            // 32 directions, and cells as wide as two strands.
            EXPECT_NEAR(share, rays.share, 0.05) << i << " " << opacity;
            least = std::min(least, rays.share);
        }
        const Seen half = brute_force(strands, glm::dvec3(kPlaces[i]), 0.5);
        EXPECT_GT(glm::dot(glm::normalize(glm::dvec3(sky.lean) + glm::dvec3(0, 1, 0)), half.from),
                  std::cos(0.12))
            << i;
    }
    EXPECT_LT(least, 0.2) << "some of the places lie deep below hair";
}

TEST(MeshCover, FarAwayNothingChanges) {
    std::vector<CoveringGroom> grooms = {over_plane(slab(500))};
    // Beside it, below the horizon of a surface that faces away, and too far for any direction.
    const std::vector<glm::vec3> at = {{0.3f, 0, 0}, {0, 0, 0}, {0, -0.02f, 40}};
    const std::vector<glm::vec3> normals = {{1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    for (const SkyAtVertex& sky : mesh_cover({at, normals, {}}, grooms).vertices) {
        EXPECT_EQ(sky.open, 1.0f);
        EXPECT_EQ(sky.depth, 0.0f);
        EXPECT_EQ(sky.lean, glm::vec3(0.0f));
    }
}

TEST(MeshCover, TurnsAndGrowsWithTheGroom) {
    const StrandData strands = slab(500);
    std::vector<CoveringGroom> straight = {over_plane(strands)};
    const glm::mat4 placement =
        glm::translate(glm::mat4(1.0f), glm::vec3(3, -2, 1)) *
        glm::rotate(glm::mat4(1.0f), 1.1f, glm::normalize(glm::vec3(1, 2, 3))) *
        glm::scale(glm::mat4(1.0f), glm::vec3(10.0f));
    std::vector<CoveringGroom> turned = {over_plane(strands, glm::inverse(placement))};
    std::vector<glm::vec3> at;
    for (const glm::vec3& p : kPlaces) at.emplace_back(placement * glm::vec4(p, 1.0f));
    const std::vector<glm::vec3> up(kPlaces.size(), glm::vec3(0, 1, 0));
    const std::vector<glm::vec3> normals(kPlaces.size(), glm::mat3(placement) * up[0]);
    const MeshCover a = mesh_cover({kPlaces, up, {}}, straight);
    const MeshCover b = mesh_cover({at, normals, {}}, turned);
    for (size_t i = 0; i < kPlaces.size(); ++i) {
        const auto share = [](const SkyAtVertex& sky) {
            return sky.open + (1.0f - sky.open) * std::exp(-0.5f * sky.depth);
        };
        // The same 64 directions meet it from elsewhere.
        EXPECT_NEAR(share(a.vertices[i]), share(b.vertices[i]), 0.06f) << i;
        const glm::vec3 lean = glm::mat3(placement) * a.vertices[i].lean / 10.0f;
        EXPECT_LT(glm::distance(lean, b.vertices[i].lean), 0.15f) << i;
    }
}

TEST(MeshCover, WhatTheMeshItselfHidesIsNoHairs) {
    // A wall between a place and the slab, as high as that seen from there.
    const std::vector<glm::vec3> positions = {{0, 0, 0.16f},
                                              {-0.5f, 0, 0.11f},
                                              {0.5f, 0, 0.11f},
                                              {0.5f, 0.3f, 0.11f},
                                              {-0.5f, 0.3f, 0.11f}};
    const std::vector<glm::vec3> normals(5, glm::vec3(0, 1, 0));
    const std::vector<glm::uvec3> wall = {{1, 2, 3}, {1, 3, 4}};
    StrandData strands = slab(500);
    // Its box has to hold the wall: a strand there that stops next to nothing.
    strands.positions.push_back({-0.5f, 0, 0.13f});
    strands.positions.push_back({0.5f, 0.3f, 0.13f});
    strands.strand_begin.push_back(static_cast<uint32_t>(strands.positions.size()));
    std::vector<CoveringGroom> grooms = {over_plane(strands)};
    const SkyAtVertex open = mesh_cover({positions, normals, {}}, grooms).vertices[0];
    const SkyAtVertex behind = mesh_cover({positions, normals, wall}, grooms).vertices[0];
    EXPECT_LT(open.open, 0.93f);
    EXPECT_GT(behind.open, 0.985f);
}

TEST(MeshCover, GroomsAddUp) {
    const StrandData strands = slab(250);
    std::vector<CoveringGroom> one = {over_plane(strands)};
    std::vector<CoveringGroom> two = {over_plane(strands), over_plane(strands)};
    const std::vector<glm::vec3> at = {{0, 0, 0}};
    const std::vector<glm::vec3> normals = {{0, 1, 0}};
    const MeshCover single = mesh_cover({at, normals, {}}, one);
    const MeshCover both = mesh_cover({at, normals, {}}, two);
    EXPECT_FLOAT_EQ(both.amounts[0], single.amounts[0]);
    EXPECT_FLOAT_EQ(both.amounts[1], single.amounts[0]);
    const auto share = [](const SkyAtVertex& sky, float lost) {
        return sky.open + (1.0f - sky.open) * std::exp(-lost * sky.depth);
    };
    EXPECT_NEAR(share(both.vertices[0], 0.3f), share(single.vertices[0], 0.6f), 0.02f);
}

}  // namespace
}  // namespace vellus::hair
