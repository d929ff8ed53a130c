#include "game_demo/src/player.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/asset/gltf.h"
#include "engine/ecs/schedule.h"
#include "modules/character/components.h"
#include "modules/character/register.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"
#include "modules/scene/time.h"

namespace vellus::demo {
namespace {

constexpr double kStep = 1.0 / 60.0;

asset::Animation still_clip(const char* name, const glm::vec3& joint_at) {
    asset::Animation clip{.name = name, .duration = 1.0f};
    clip.channels.push_back(
        {.node = 1,
         .times = {0.0f, 1.0f},
         .values = {joint_at.x, joint_at.y, joint_at.z, joint_at.x, joint_at.y, joint_at.z}});
    return clip;
}

/// A node "hero" that walks, with a joint that its clips hold at one place each.
class PlayerTest : public testing::Test {
  protected:
    void load(const std::string& json) {
        auto scene = std::make_shared<asset::SceneAsset>();
        scene->path = "hero.gltf";
        scene->nodes.resize(2);
        scene->nodes[0].children = {1};
        scene->nodes[0].extensions.push_back({kPlayerExtensionName, json});
        scene->nodes[1].parent = 0;
        scene->roots = {0};
        scene->animations = {still_clip("stand", {0.0f, 1.0f, 0.0f}),
                             still_clip("walk", {0.0f, 3.0f, 0.0f})};
        const auto instance = scene::instantiate(world_, scene);
        ASSERT_TRUE(instance);
        const auto& library = world_.resource<scene::SceneLibrary>();
        world_.add(library.instances[*instance].root, character::AnimationPlayer{});
        hero_ = library.entity(*instance, 0);
        joint_ = library.entity(*instance, 1);
        scene::register_scene(world_, schedule_);
        character::register_character(world_, schedule_);
        ASSERT_TRUE(schedule_.build(world_));
    }
    void walk(const glm::dvec3& wish, double yaw, double seconds) {
        for (int i = 0; i < std::lround(seconds / kStep); ++i) {
            player_->update(world_, wish, yaw, kStep);
            schedule_.run(world_);
        }
    }

    World world_;
    Schedule schedule_{"frame"};
    Entity hero_ = kNoEntity;
    Entity joint_ = kNoEntity;
    std::unique_ptr<Player> player_;
};

constexpr const char* kHero = R"({"walk": "walk", "idle": "stand", "speed": 1.5})";

TEST_F(PlayerTest, WalksAheadAsTheCameraSeesItAtTheClipsSpeed) {
    load(kHero);
    player_ = std::move(*Player::find(world_));
    ASSERT_TRUE(player_);
    walk({0.0, 0.0, -1.0}, 0.0, 2.0);
    const glm::dvec3 reached = player_->position(world_);
    walk({0.0, 0.0, -1.0}, 0.0, 1.0);
    EXPECT_NEAR(player_->position(world_).z - reached.z, -1.5, 0.01) << "away from the camera";
    EXPECT_EQ(player_->position(world_).y, 0.0);
    // A camera turned left by a right angle looks along -X.
    walk({0.0, 0.0, -1.0}, 0.5 * std::acos(-1.0), 2.0);
    const glm::dvec3 turned = player_->position(world_);
    walk({0.0, 0.0, -1.0}, 0.5 * std::acos(-1.0), 1.0);
    EXPECT_NEAR(player_->position(world_).x - turned.x, -1.5, 0.01);
}

TEST_F(PlayerTest, ClipsFollowTheSpeed) {
    load(kHero);
    player_ = std::move(*Player::find(world_));
    const auto height = [&] { return world_.get<scene::LocalTransform>(joint_)->translation.y; };
    walk({}, 0.0, 0.5);
    EXPECT_NEAR(height(), 1.0, 1e-5) << "the scene's own first clip until somebody walks";
    walk({1.0, 0.0, 0.0}, 0.0, 2.0);
    EXPECT_NEAR(height(), 3.0, 1e-4);
    walk({}, 0.0, 0.1);
    EXPECT_GT(height(), 1.0);
    EXPECT_LE(height(), 3.0);
    walk({}, 0.0, 3.0);
    EXPECT_NEAR(height(), 1.0, 1e-4);
}

TEST_F(PlayerTest, TheSameSecondsLeadToTheSamePlaceAtAnyFrameRate) {
    load(kHero);
    player_ = std::move(*Player::find(world_));
    for (int i = 0; i < 300; ++i) player_->update(world_, {0.3, 0.0, -0.8}, 0.4, 0.01);
    schedule_.run(world_);
    const glm::dvec3 fine = player_->position(world_);
    *world_.get<scene::LocalTransform>(hero_) = {};
    schedule_.run(world_);
    auto again = std::move(*Player::find(world_));
    for (int i = 0; i < 60; ++i) again->update(world_, {0.3, 0.0, -0.8}, 0.4, 0.05);
    schedule_.run(world_);
    // The first-order ease leaves a difference of about half a step of its time constant.
    EXPECT_LT(glm::length(again->position(world_) - fine), 0.1);
    EXPECT_GT(glm::length(fine), 3.0);
}

TEST_F(PlayerTest, AMissingClipIsAnErrorThatNamesIt) {
    load(R"({"walk": "run"})");
    const auto player = Player::find(world_);
    ASSERT_FALSE(player);
    EXPECT_NE(player.error().message().find("\"run\""), std::string::npos);
    EXPECT_NE(player.error().message().find("hero.gltf"), std::string::npos);
}

/// The project's own crowd without its hair.
class Crowd {
  public:
    Crowd() {
        auto asset = asset::load_gltf(VELLUS_SOURCE_DIR "/assets/scenes/crowd.gltf");
        const auto instance =
            scene::instantiate(world_, std::make_shared<asset::SceneAsset>(*std::move(asset)));
        const auto& library = world_.resource<scene::SceneLibrary>();
        world_.add(library.instances[*instance].root, character::AnimationPlayer{});
        scene::register_scene(world_, schedule_);
        character::register_character(world_, schedule_);
        EXPECT_TRUE(schedule_.build(world_));
        schedule_.run(world_);
        auto found = Player::find(world_);
        EXPECT_TRUE(found && *found);
        player_ = std::move(*found);
    }
    void walk(const glm::dvec3& wish, int frames) {
        for (int i = 0; i < frames; ++i) {
            player_->update(world_, wish, 0.0, kStep);
            schedule_.run(world_);
        }
    }
    glm::dmat4 place(const std::string& name) {
        const auto& library = world_.resource<scene::SceneLibrary>();
        const auto& nodes = library.asset_of(library.instances[0]).nodes;
        for (uint32_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].name != name) continue;
            return world_.get<scene::WorldTransform>(library.entity(0, i))->matrix;
        }
        ADD_FAILURE() << name;
        return glm::dmat4(1.0);
    }

  private:
    World world_;
    Schedule schedule_{"frame"};
    std::unique_ptr<Player> player_;
};

double apart(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0.0;
    for (int i = 0; i < 4; ++i) most = std::max(most, glm::length(a[i] - b[i]));
    return most;
}

TEST(CrowdPlayer, OneOfTheNineWalksAndTheOthersKeepTheirOwnTime) {
    Crowd walked;
    Crowd left_alone;
    walked.walk({0.0, 0.0, 1.0}, 120);
    left_alone.walk({}, 120);
    const double way =
        glm::length(glm::dvec3(walked.place("person_2")[3] - left_alone.place("person_2")[3]));
    // Two seconds at 1.1 m/s, less the turn and the start.
    EXPECT_GT(way, 1.5);
    EXPECT_LT(way, 2.4);
    EXPECT_GT(apart(walked.place("2_shin_l"), left_alone.place("2_shin_l")), 1.0);
    for (const char* person : {"1", "3", "4", "5", "6", "7", "8", "9"}) {
        const std::string head = std::string(person) + "_head";
        EXPECT_LT(apart(walked.place(head), left_alone.place(head)), 1e-6) << head;
    }
    // Out of step with each other: heads of equal people would be turned alike.
    EXPECT_GT(apart(glm::dmat4(glm::dmat3(walked.place("1_head"))),
                    glm::dmat4(glm::dmat3(walked.place("3_head")))),
              0.01);
}

TEST(CrowdPlayer, WalksUpToSomeoneAndNotThroughThem) {
    Crowd crowd;
    const auto way = [&] {
        const glm::dvec3 to = crowd.place("5_head")[3] - crowd.place("2_head")[3];
        return glm::dvec3(to.x, 0.0, to.z);
    };
    double nearest = glm::length(way());
    ASSERT_GT(nearest, 1.0);
    for (int frame = 0; frame < 600; ++frame) {
        crowd.walk(glm::normalize(way()), 1);
        nearest = std::min(nearest, glm::length(way()));
    }
    // Half a metre between the middles of two bodies whose heads lean less than a hand's breadth.
    EXPECT_GT(nearest, 0.35);
    EXPECT_LT(glm::length(way()), 0.65);
}

TEST(PlayerExtensionTest, RefusesWhatIsNoClipAndNoSpeed) {
    for (const char* json : {R"({})", R"({"walk": 3})", R"({"walk": "w", "speed": 0})", "[", "7"}) {
        EXPECT_FALSE(parse_player_extension(json, "scene.gltf")) << json;
    }
    const auto good = parse_player_extension(R"({"walk": "w"})", "scene.gltf");
    ASSERT_TRUE(good);
    EXPECT_EQ(good->walk, "w");
    EXPECT_TRUE(good->idle.empty());
}

}  // namespace
}  // namespace vellus::demo
