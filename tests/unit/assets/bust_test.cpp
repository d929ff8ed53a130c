#include "assets/generator/bust.h"

#include <gtest/gtest.h>

#include "assets/generator/bust_mesh.h"
#include "assets/generator/sdf.h"
#include "tests/unit/assets/surface_check.h"

namespace vellus::sculpt {
namespace {

const std::vector<Part>& parts() {
    static const std::vector<Part> made = make_bust();
    return made;
}

TEST(Bust, EveryPartIsAClosedManifoldWithoutHoles) {
    for (const Part& part : parts()) {
        expect_closed(part.surface, part.name);
        EXPECT_EQ(count_pieces(part.surface), 1U) << part.name;
    }
}

TEST(Bust, TrianglesFaceOutwardsLikeTheirNormals) {
    for (const Part& part : parts()) {
        const Surface& s = part.surface;
        size_t against = 0;
        for (size_t i = 0; i < s.indices.size(); i += 3) {
            const glm::dvec3 a = s.positions[s.indices[i]];
            const glm::dvec3 n =
                glm::cross(s.positions[s.indices[i + 1]] - a, s.positions[s.indices[i + 2]] - a);
            against += glm::dot(n, s.normals[s.indices[i]]) < 0.0 ? 1 : 0;
        }
        // At the rims of lids and nostrils a normal may lean across its triangle.
        EXPECT_LT(against, s.indices.size() / 3 / 200) << part.name;
        for (const glm::dvec3 n : s.normals) {
            EXPECT_NEAR(glm::length(n), 1.0, 1e-9) << part.name;
        }
    }
}

TEST(Bust, VerticesLieOnTheSculptedSurface) {
    size_t off = 0;
    for (const glm::dvec3 p : parts()[0].surface.positions) {
        // Half a millimetre: less than a pixel in a portrait.
        off += std::abs(skin_distance(p)) > 5e-4 ? 1 : 0;
    }
    EXPECT_LT(off, parts()[0].surface.positions.size() / 200);
}

TEST(Bust, HeadHasHumanProportions) {
    const auto extent = [](glm::dvec3 from, glm::dvec3 direction) {
        double far = 0.0;
        for (int step = 0; step < 1600; ++step) {
            const double t = step * 1e-4;
            far = skin_distance(from + direction * t) < 0.0 ? t : far;
        }
        return far;
    };
    const double crown = extent({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    // In front of the neck, straight down through the chin.
    const double chin = extent({0.0, 0.0, 0.062}, {0.0, -1.0, 0.0});
    EXPECT_NEAR(crown + chin, 0.23, 0.005);
    // Eyes at half the height of the head.
    EXPECT_NEAR(crown - kEyeCenter.y, chin + kEyeCenter.y, 0.005);
    const double width = 2.0 * extent({0.0, 0.035, -0.014}, {1.0, 0.0, 0.0});
    EXPECT_NEAR(width, 0.15, 0.006);
}

TEST(Bust, JointWeightsAreSharesThatAddUpToOne) {
    for (const Part& part : parts()) {
        for (const glm::dvec3 w : part.weights) {
            EXPECT_NEAR(w.x + w.y + w.z, 1.0, 1e-12);
            EXPECT_GE(std::min({w.x, w.y, w.z}), 0.0);
        }
    }
    EXPECT_EQ(joint_weights({0.0, -0.11, 0.066}), glm::dvec3(0.0, 0.0, 1.0)) << "chin";
    EXPECT_EQ(joint_weights({0.0, -0.35, 0.0}), glm::dvec3(1.0, 0.0, 0.0)) << "chest";
}

}  // namespace
}  // namespace vellus::sculpt
