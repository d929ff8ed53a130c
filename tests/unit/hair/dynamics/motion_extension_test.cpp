#include <gtest/gtest.h>

#include "modules/hair/dynamics/collider_extension.h"
#include "modules/hair/groom/hair_extension.h"

namespace vellus::hair {
namespace {

TEST(MotionExtension, EveryFieldIsRead) {
    const auto hair = parse_hair_extension(
        R"({"groom": "a.hair", "motion": {"bend_length": 0.1, "twist": 0.5, "damping": 0.2,
            "drag": 3, "hold": 0.4, "friction": 9, "wind": 0.5, "gravity": 0.8, "guides": 50,
            "smallest_pixels": 30, "enabled": false, "solver": "device"}})",
        "scene");
    ASSERT_TRUE(hair) << hair.error().message();
    ASSERT_TRUE(hair->motion);
    const MotionSettings expected{.bend_length = 0.1f,
                                  .twist = 0.5f,
                                  .damping = 0.2f,
                                  .drag = 3.0f,
                                  .hold = 0.4f,
                                  .friction = 9.0f,
                                  .wind = 0.5f,
                                  .gravity = 0.8f};
    EXPECT_EQ(hair->motion->motion.settings, expected);
    EXPECT_EQ(hair->motion->guides, 50u);
    EXPECT_FLOAT_EQ(hair->motion->motion.smallest_pixels, 30.0f);
    EXPECT_FALSE(hair->motion->motion.enabled);
    EXPECT_EQ(hair->motion->motion.solver, MotionSolver::kDevice);
    EXPECT_TRUE(hair->warnings.empty());
}

TEST(MotionExtension, WithoutItNothingMovesAndEmptyMeansDefaults) {
    const auto still = parse_hair_extension(R"({"groom": "a.hair"})", "scene");
    ASSERT_TRUE(still);
    EXPECT_FALSE(still->motion);
    const auto moving = parse_hair_extension(R"({"groom": "a.hair", "motion": {}})", "scene");
    ASSERT_TRUE(moving);
    ASSERT_TRUE(moving->motion);
    EXPECT_EQ(moving->motion->motion.settings, MotionSettings{});
    EXPECT_EQ(moving->motion->motion.solver, MotionSolver::kProcessor);
}

TEST(MotionExtension, WrongFieldsAreNamed) {
    const struct {
        const char* json;
        const char* field;
    } cases[] = {
        {R"({"groom": "a", "motion": {"bend_length": 0}})", "bend_length"},
        {R"({"groom": "a", "motion": {"hold": -1}})", "hold"},
        {R"({"groom": "a", "motion": {"solver": "cloud"}})", "solver"},
        {R"({"groom": "a", "motion": {"drag": "much"}})", "drag"},
        {R"({"groom": "a", "motion": 3})", "motion"},
    };
    for (const auto& c : cases) {
        const auto hair = parse_hair_extension(c.json, "scene.gltf: node 0");
        ASSERT_FALSE(hair) << c.json;
        EXPECT_NE(hair.error().message().find(c.field), std::string::npos)
            << hair.error().message();
    }
    const auto unknown =
        parse_hair_extension(R"({"groom": "a", "motion": {"bounce": 1}})", "scene");
    ASSERT_TRUE(unknown);
    ASSERT_EQ(unknown->warnings.size(), 1u);
    EXPECT_NE(unknown->warnings[0].find("bounce"), std::string::npos);
}

TEST(ColliderExtension, CapsuleAndSphere) {
    const auto capsule = parse_collider_extension(
        R"({"radius": 0.1, "from": [0, 1, 0], "to": [0, 2, 0.5]})", "scene");
    ASSERT_TRUE(capsule) << capsule.error().message();
    EXPECT_EQ(capsule->collider.from, glm::vec3(0, 1, 0));
    EXPECT_EQ(capsule->collider.to, glm::vec3(0, 2, 0.5f));
    EXPECT_FLOAT_EQ(capsule->collider.radius, 0.1f);
    const auto sphere =
        parse_collider_extension(R"({"radius": 0.2, "from": [1, 2, 3], "color": 1})", "scene");
    ASSERT_TRUE(sphere);
    EXPECT_EQ(sphere->collider.to, glm::vec3(1, 2, 3));
    EXPECT_EQ(sphere->warnings.size(), 1u);
}

TEST(ColliderExtension, WrongFieldsAreNamed) {
    for (const auto& [json, field] : {std::pair{R"({"from": [0, 0, 0]})", "radius"},
                                      {R"({"radius": -1})", "radius"},
                                      {R"({"radius": 1, "to": [0, 0]})", "to"},
                                      {R"([1])", "object"}}) {
        const auto read = parse_collider_extension(json, "scene.gltf: node 4 'head'");
        ASSERT_FALSE(read) << json;
        EXPECT_NE(read.error().message().find(field), std::string::npos) << read.error().message();
        EXPECT_NE(read.error().message().find("node 4"), std::string::npos);
    }
}

}  // namespace
}  // namespace vellus::hair
