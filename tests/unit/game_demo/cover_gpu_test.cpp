#include <algorithm>

#include "modules/character/components.h"
#include "modules/hair/environment/cover_meshes.h"
#include "modules/scene/components.h"
#include "tests/unit/game_demo/scene_test.h"

// Which meshes of the project's own scenes hair keeps the sky from.
namespace vellus::demo {
namespace {

class CoverScenes : public SceneTest {
  protected:
    /// Number of grooms on each covered mesh, and of meshes that have none.
    std::pair<std::vector<size_t>, size_t> covers() {
        std::vector<size_t> grooms;
        size_t bare = 0;
        for (const hair::MeshBelow& below : world().resource<hair::HairCovers>().meshes) {
            grooms.push_back(below.hair.size());
        }
        world().query<const scene::MeshInstance, const character::SkyCover*>().each(
            [&](const scene::MeshInstance&, const character::SkyCover* cover) {
                bare += cover == nullptr ? 1 : 0;
            });
        return {grooms, bare};
    }
};

TEST_F(CoverScenes, HairAndBrowsLieOnOneBust) {
    ASSERT_NO_FATAL_FAILURE(open("portrait"));
    draw_frame();
    EXPECT_EQ(covers(), std::pair(std::vector<size_t>{2}, size_t{0}));
}

TEST_F(CoverScenes, TheGroundIsNoneOfTheWalkersHair) {
    ASSERT_NO_FATAL_FAILURE(open("walk"));
    draw_frame();
    EXPECT_EQ(covers(), std::pair(std::vector<size_t>{1}, size_t{1}));
}

TEST_F(CoverScenes, EachOfACrowdWearsItsOwn) {
    ASSERT_NO_FATAL_FAILURE(open("crowd"));
    draw_frame();
    const auto [grooms, bare] = covers();
    EXPECT_TRUE(std::ranges::all_of(grooms, [](size_t count) { return count == 1; }));
    EXPECT_EQ(grooms.size() + bare, 10u);
    EXPECT_GE(grooms.size(), 1u);
    EXPECT_GE(bare, 1u) << "the ground";
}

}  // namespace
}  // namespace vellus::demo
