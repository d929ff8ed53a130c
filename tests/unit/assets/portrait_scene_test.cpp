#include <gtest/gtest.h>

#include <filesystem>

#include "engine/asset/gltf.h"
#include "modules/hair/groom/hair_extension.h"

namespace vellus::sculpt {
namespace {

TEST(PortraitScene, LoadsWithItsGrooms) {
    const std::filesystem::path kAssets = std::filesystem::path(VELLUS_SOURCE_DIR) / "assets";
    const auto scene = asset::load_gltf(kAssets / "scenes/portrait.gltf");
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_TRUE(scene->warnings.empty()) << scene->warnings.front();
    EXPECT_EQ(scene->cameras.size(), 1U);
    EXPECT_EQ(scene->lights.size(), 2U);
    EXPECT_EQ(scene->animations.size(), 1U);
    int grooms = 0;
    for (const asset::Node& node : scene->nodes) {
        for (const asset::Extension& extension : node.extensions) {
            if (extension.name != hair::kHairExtensionName) {
                continue;
            }
            const auto parsed = hair::parse_hair_extension(extension.json, node.name);
            ASSERT_TRUE(parsed) << parsed.error().message();
            EXPECT_TRUE(parsed->warnings.empty()) << parsed->warnings.front();
            EXPECT_TRUE(std::filesystem::exists(kAssets / "scenes" / parsed->groom));
            EXPECT_EQ(scene->nodes[node.parent].name, "head");
            // From the file's centimetres with Z up to the bust's metres with Y up.
            const glm::dvec4 p = parsed->transform() * glm::dvec4(1.0, -2.0, 3.0, 1.0);
            EXPECT_LT(glm::distance(glm::dvec3(p), glm::dvec3(0.01, 0.03, 0.02)), 1e-12);
            ++grooms;
        }
    }
    EXPECT_EQ(grooms, 2);
}

}  // namespace
}  // namespace vellus::sculpt
