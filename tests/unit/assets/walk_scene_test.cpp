#include "assets/generator/walk_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "assets/generator/bust.h"
#include "engine/asset/gltf.h"
#include "engine/platform/files.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/hair_extension.h"

namespace vellus::sculpt {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(VELLUS_SOURCE_DIR) / "assets";

TEST(WalkScene, LoadsWithClipsCameraAndHair) {
    const auto scene = asset::load_gltf(kAssets / "scenes/walk.gltf");
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_TRUE(scene->warnings.empty()) << scene->warnings.front();
    EXPECT_EQ(scene->cameras.size(), 1U);
    EXPECT_EQ(scene->lights.size(), 1U);
    ASSERT_EQ(scene->skins.size(), 1U);
    EXPECT_EQ(scene->skins[0].joints.size(), 21U);
    for (const char* clip : {"stroll", "walk", "idle"}) {
        EXPECT_TRUE(std::ranges::any_of(scene->animations, [&](const auto& a) {
            return a.name == clip;
        })) << clip;
    }
    const auto hair = std::ranges::find(scene->nodes, "hair", &asset::Node::name);
    ASSERT_NE(hair, scene->nodes.end());
    ASSERT_EQ(hair->extensions.size(), 1U);
    const auto parsed = hair::parse_hair_extension(hair->extensions[0].json, "hair");
    ASSERT_TRUE(parsed) << parsed.error().message();
    EXPECT_TRUE(parsed->warnings.empty()) << parsed->warnings.front();
    EXPECT_TRUE(std::filesystem::exists(kAssets / "scenes" / parsed->groom));
}

TEST(WalkScene, HairIsRootedInTheScalpAndOutsideTheBody) {
    const auto bytes = read_file(kAssets / "grooms/walk.hair");
    ASSERT_TRUE(bytes) << bytes.error().message();
    auto groom = hair::read_hair(*bytes, "walk.hair");
    ASSERT_TRUE(groom) << groom.error().message();
    EXPECT_TRUE(hair::repair(*groom).clean());
    for (size_t s = 0; s < groom->strand_count(); ++s) {
        for (uint32_t i = groom->strand_begin[s]; i < groom->strand_begin[s + 1]; ++i) {
            const glm::dvec3 p(groom->points[i].x, groom->points[i].z, -groom->points[i].y);
            const double depth = skin_distance(p * 0.01);
            EXPECT_GT(depth, -0.001) << s;
            if (i == groom->strand_begin[s]) {
                EXPECT_LT(depth, 0.001) << s;
            }
        }
    }
}

TEST(WalkScene, LapClosesItsPath) {
    const Gait gait = lap_gait();
    EXPECT_NEAR(kLapStrides * gait.stride_metres, 2.0 * 3.14159265358979 * gait.turn_radius, 1e-9);
}

TEST(Assets, AreAFewMegabytes) {
    uintmax_t bytes = 0;
    for (const char* folder : {"scenes", "grooms"}) {
        for (const auto& file : std::filesystem::directory_iterator(kAssets / folder)) {
            bytes += file.file_size();
        }
    }
    EXPECT_LT(bytes, 9'500'000U);
}

}  // namespace
}  // namespace vellus::sculpt
