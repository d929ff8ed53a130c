#include "assets/generator/fox.h"

#include <gtest/gtest.h>

#include <numeric>

#include "assets/generator/sdf.h"
#include "tests/unit/assets/surface_check.h"

namespace vellus::sculpt {
namespace {

const std::vector<SkinnedPart>& parts() {
    static const std::vector<SkinnedPart> made = make_fox();
    return made;
}

TEST(Fox, EveryPartIsClosed) {
    const std::array<size_t, 3> pieces = {1, 1, 2};
    ASSERT_EQ(parts().size(), pieces.size());
    for (size_t i = 0; i < pieces.size(); ++i) {
        expect_closed(parts()[i].surface, parts()[i].name);
        EXPECT_EQ(count_pieces(parts()[i].surface), pieces[i]) << parts()[i].name;
    }
}

TEST(Fox, WeightsAddUpToOne) {
    for (const SkinnedPart& part : parts()) {
        for (const Influences& at : part.influences) {
            EXPECT_NEAR(std::accumulate(at.weights.begin(), at.weights.end(), 0.0), 1.0, 1e-12);
            EXPECT_GE(*std::ranges::min_element(at.weights), 0.0);
        }
    }
}

TEST(Fox, PawsStayOnTheGroundWhileItLooksRound) {
    const SkinnedPart& skin = parts()[0];
    for (int key = 0; key < 16; ++key) {
        const auto frames = frames_of(fox_joints(), fox_pose(key / 16.0));
        for (size_t v = 0; v < skin.surface.positions.size(); ++v) {
            const glm::dvec3 p = skin.surface.positions[v];
            if (p.y < 0.02) {
                const glm::dvec3 now = skinned(fox_joints(), frames, skin.influences[v], p);
                EXPECT_LT(glm::distance(p, now), 0.005);
            }
        }
    }
}

TEST(Fox, ClipRepeatsItself) {
    const auto a = frames_of(fox_joints(), fox_pose(0.0));
    const auto b = frames_of(fox_joints(), fox_pose(1.0));
    for (size_t j = 0; j < a.size(); ++j) {
        EXPECT_LT(glm::distance(a[j].position, b[j].position), 1e-12);
    }
}

TEST(Fox, FurIsRootedOnTheSkinAndCoversIt) {
    const Surface& skin = parts()[0].surface;
    const Fur fur = grow_fox_fur(parts()[0]);
    EXPECT_GT(fur.strands.size(), 10'000U);
    ASSERT_EQ(fur.colors.size(), 4 * fur.strands.size());
    for (const Strand& strand : fur.strands) {
        // On a triangle, so off the curved field by its sagitta: 15 mm edges, 20 mm radii.
        EXPECT_LT(std::abs(fox_skin(strand[0])), 0.0015);
    }
    // No bald spot: within two centimetres of every vertex grows a hair.
    for (size_t v = 0; v < skin.positions.size(); v += 7) {
        double nearest = 1.0;
        for (const Strand& strand : fur.strands) {
            nearest = std::min(nearest, glm::distance(strand[0], skin.positions[v]));
        }
        EXPECT_LT(nearest, 0.02) << skin.positions[v].x << ' ' << skin.positions[v].y << ' '
                                 << skin.positions[v].z;
    }
}

}  // namespace
}  // namespace vellus::sculpt
