#include "modules/character/components.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "tests/unit/game_demo/scene_test.h"

// The project's own crowd, as the demo draws it.
namespace vellus::demo {
namespace {

class CrowdMotion : public SceneTest {
  protected:
    void SetUp() override {
        SceneTest::SetUp();
        ASSERT_NO_FATAL_FAILURE(open("crowd"));
        world().query<hair::HairMotion>().each(
            [](hair::HairMotion& motion) { motion.solver = hair::MotionSolver::kProcessor; });
    }
    character::AnimationPlayer& clips() {
        Entity found = kNoEntity;
        world().query<Entity, const character::AnimationPlayer>().each(
            [&](Entity entity, const character::AnimationPlayer&) { found = entity; });
        return *world().get<character::AnimationPlayer>(found);
    }
    /// Every point of every guide that moves, in the world.
    std::vector<glm::dvec3> guide_points() {
        std::vector<glm::dvec3> points;
        for (const auto& groom : world().resource<hair::HairMotions>().list) {
            const hair::GuideSet& guides = groom->motion.guides();
            const double scale = static_cast<double>(groom->motion.work().params.scale);
            for (uint32_t g = 0; g < guides.count; ++g) {
                const hair::RootPose& root = groom->roots[g];
                hair::visit_guide_points(
                    guides, groom->motion.state(), g, [&](const glm::vec3& point) {
                        points.push_back(root.place + root.turn * (scale * glm::dvec3(point)));
                    });
            }
        }
        return points;
    }
};

TEST_F(CrowdMotion, HairOfPeopleWhoStandStillStaysWhereTheFirstFrameShowsIt) {
    clips().speed = 0.0;
    draw_frame();
    const std::vector<glm::dvec3> first = guide_points();
    ASSERT_FALSE(first.empty());
    double worst = 0.0;
    for (int frame = 1; frame <= 60; ++frame) {
        draw_frame();
        const std::vector<glm::dvec3> now = guide_points();
        for (size_t i = 0; i < now.size(); ++i) {
            worst = std::max(worst, glm::distance(now[i], first[i]));
        }
    }
    RecordProperty("worst_metres", std::to_string(worst));
    EXPECT_LT(worst, 0.01);
}

}  // namespace
}  // namespace vellus::demo
