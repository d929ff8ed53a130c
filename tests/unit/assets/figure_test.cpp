#include "assets/generator/figure.h"

#include <gtest/gtest.h>

#include "assets/generator/figure_mesh.h"
#include "assets/generator/walk_cycle.h"
#include "tests/unit/assets/surface_check.h"

namespace vellus::sculpt {
namespace {

const std::vector<SkinnedPart>& parts() {
    static const std::vector<SkinnedPart> made = make_figure(false);
    return made;
}

TEST(Figure, EveryPartIsClosedAndHasTheExpectedPieces) {
    // Head and two arms, one top, one pair of trousers, two shoes, two eyes.
    const std::array<size_t, 5> pieces = {3, 1, 1, 2, 2};
    ASSERT_EQ(parts().size(), pieces.size());
    size_t triangles = 0;
    for (size_t i = 0; i < pieces.size(); ++i) {
        expect_closed(parts()[i].surface, parts()[i].name);
        EXPECT_EQ(count_pieces(parts()[i].surface), pieces[i]) << parts()[i].name;
        triangles += parts()[i].surface.indices.size() / 3;
    }
    EXPECT_LT(triangles, 15'000U);
}

TEST(Figure, StandsOnTheGround) {
    double lowest = 1.0;
    double highest = 0.0;
    for (const SkinnedPart& part : parts()) {
        for (const glm::dvec3 p : part.surface.positions) {
            lowest = std::min(lowest, p.y);
            highest = std::max(highest, p.y);
        }
    }
    EXPECT_NEAR(lowest, 0.0, 0.002);
    EXPECT_NEAR(highest, 1.66, 0.01);
}

TEST(Figure, WeightsAddUpToOneAndVarySmoothly) {
    for (const SkinnedPart& part : parts()) {
        ASSERT_EQ(part.influences.size(), part.surface.positions.size());
        for (const Influences& at : part.influences) {
            EXPECT_NEAR(at.weights[0] + at.weights[1] + at.weights[2] + at.weights[3], 1.0, 1e-12);
            EXPECT_GE(at.weights[3], 0.0);
            EXPECT_GE(at.weights[0], at.weights[1]);
        }
        const auto& indices = part.surface.indices;
        for (size_t i = 0; i < indices.size(); ++i) {
            const uint32_t a = indices[i];
            const uint32_t b = indices[i % 3 == 2 ? i - 2 : i + 1];
            std::array<double, kFigureJoints> change{};
            for (size_t k = 0; k < 4; ++k) {
                change[part.influences[a].joints[k]] += part.influences[a].weights[k];
                change[part.influences[b].joints[k]] -= part.influences[b].weights[k];
            }
            double most = 0.0;
            for (const double c : change) {
                most = std::max(most, std::abs(c));
            }
            const double length =
                glm::distance(part.surface.positions[a], part.surface.positions[b]);
            // The steepest ramp parts the thighs: 32 mm, slope 1.5 in the middle of a smoothstep.
            EXPECT_LT(most, 0.02 + length * 1.5 / 0.032) << part.name;
        }
    }
}

/// A triangle's area over its area at rest.
double stretch(const SkinnedPart& part, std::span<const Frame> frames, size_t triangle) {
    std::array<glm::dvec3, 3> rest;
    std::array<glm::dvec3, 3> bent;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = part.surface.indices[triangle + k];
        rest[k] = part.surface.positions[v];
        bent[k] = skinned(figure_joints(), frames, part.influences[v], rest[k]);
    }
    return glm::length(glm::cross(bent[1] - bent[0], bent[2] - bent[0])) /
           glm::length(glm::cross(rest[1] - rest[0], rest[2] - rest[0]));
}

TEST(Figure, KeepsItsSurfaceWhileItWalks) {
    for (int key = 0; key < 8; ++key) {
        const auto frames = frames_of(figure_joints(), walk_pose({}, key / 8.0));
        for (const SkinnedPart& part : parts()) {
            size_t collapsed = 0;
            for (size_t i = 0; i < part.surface.indices.size(); i += 3) {
                const double area = stretch(part, frames, i);
                collapsed += area < 0.1 || area > 6.0 ? 1 : 0;
            }
            // Armpit, groin and the hollow of the knee fold.
            EXPECT_LT(collapsed, part.surface.indices.size() / 3 / 50) << part.name << key;
        }
    }
}

}  // namespace
}  // namespace vellus::sculpt
