#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "modules/character/components.h"
#include "modules/hair/dynamics/components.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "tests/support/gpu_fixture.h"

// The project's own crowd, as the demo draws it.
namespace vellus::demo {
namespace {

class CrowdMotion : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        auto made = Renderer::create(device(), {});
        ASSERT_TRUE(made) << made.error().message();
        renderer_ = std::move(*made);
        Options options;
        options.scene = VELLUS_SOURCE_DIR "/assets/scenes/crowd.gltf";
        options.size = {64, 64};
        ASSERT_TRUE(load_content(*renderer_, options));
        world().query<hair::HairMotion>().each([](hair::HairMotion& motion) {
            motion.smallest_pixels = 0.0f;
            motion.solver = hair::MotionSolver::kProcessor;
        });
    }
    World& world() { return renderer_->world(); }
    void draw() {
        EXPECT_TRUE(renderer_->draw(Output::kNowhere));
        EXPECT_TRUE(renderer_->wait());
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

  private:
    std::unique_ptr<Renderer> renderer_;
};

TEST_F(CrowdMotion, HairOfPeopleWhoStandStillStaysWhereTheFirstFrameShowsIt) {
    clips().speed = 0.0;
    draw();
    const std::vector<glm::dvec3> first = guide_points();
    ASSERT_FALSE(first.empty());
    double worst = 0.0;
    for (int frame = 1; frame <= 60; ++frame) {
        draw();
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
