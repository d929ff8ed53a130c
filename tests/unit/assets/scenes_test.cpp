#include <gtest/gtest.h>

#include <filesystem>

#include "engine/asset/gltf.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/hair_extension.h"

namespace vellus::sculpt {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(VELLUS_SOURCE_DIR) / "assets";

struct Expected {
    const char* name;
    size_t grooms, skins, joints;
};

class Scene : public testing::TestWithParam<Expected> {};

TEST_P(Scene, LoadsWithoutWarningAndItsGroomsAreThere) {
    const auto scene =
        asset::load_gltf(kAssets / "scenes" / (std::string(GetParam().name) + ".gltf"));
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_TRUE(scene->warnings.empty()) << scene->warnings.front();
    EXPECT_EQ(scene->cameras.size(), 1U);
    EXPECT_EQ(scene->lights.size(), 1U);
    ASSERT_EQ(scene->skins.size(), GetParam().skins);
    for (const auto& skin : scene->skins) {
        EXPECT_EQ(skin.joints.size(), GetParam().joints);
    }
    EXPECT_FALSE(scene->animations.empty());
    size_t grooms = 0;
    for (const asset::Node& node : scene->nodes) {
        for (const asset::Extension& extension : node.extensions) {
            if (extension.name != hair::kHairExtensionName) {
                continue;
            }
            const auto parsed = hair::parse_hair_extension(extension.json, node.name);
            ASSERT_TRUE(parsed) << parsed.error().message();
            EXPECT_TRUE(parsed->warnings.empty()) << parsed->warnings.front();
            const auto groom = hair::load_groom(kAssets / "scenes" / parsed->groom);
            ASSERT_TRUE(groom) << groom.error().message();
            EXPECT_TRUE(groom->report.clean()) << hair::to_text(groom->report);
            ++grooms;
        }
    }
    EXPECT_EQ(grooms, GetParam().grooms);
}

INSTANTIATE_TEST_SUITE_P(Made, Scene,
                         testing::Values(Expected{"walk", 1, 1, 21}, Expected{"crowd", 9, 9, 21},
                                         Expected{"fur", 1, 1, 19}),
                         [](const auto& expected) { return std::string(expected.param.name); });

}  // namespace
}  // namespace vellus::sculpt
