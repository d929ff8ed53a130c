#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/asset/image_io.h"
#include "tests/golden/picture.h"

// The project's own scenes against pictures kept in tests/golden/images. To renew them after a
// change that is meant: VELLUS_RENEW_GOLDEN=1 ctest --test-dir build -R Golden, look at them,
// commit.
namespace vellus {
namespace {

namespace fs = std::filesystem;

const std::string kAssets = VELLUS_SOURCE_DIR "/assets/";

void check(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--size", "320x240", "--frames", "24"});
    const auto pictures = test::render(name, arguments);
    ASSERT_EQ(pictures.size(), 1u);
    const fs::path kept = fs::path(VELLUS_SOURCE_DIR) / "tests/golden/images" / (name + ".png");
    if (std::getenv("VELLUS_RENEW_GOLDEN")) {
        ASSERT_TRUE(asset::save_png(kept, pictures[0]));
        GTEST_SKIP() << "renewed " << kept;
    }
    auto golden = asset::load_image(kept);
    ASSERT_TRUE(golden) << golden.error().message();
    ASSERT_EQ(golden->width, pictures[0].width);
    ASSERT_EQ(golden->height, pictures[0].height);
    // The same device repeats the picture to the bit. Another one rounds sines and depths its own
    // way, which decides some strands' dither differently: noise of one strand here and there,
    // while a lost lobe, shadow or strand width moves whole regions by tens of steps.
    const test::Difference difference = test::compare(*golden, pictures[0]);
    EXPECT_LE(difference.mean, 1.5) << kept;
    EXPECT_LE(difference.large_share, 0.01) << kept;
}

TEST(Golden, Portrait) {
    check("portrait", {kAssets + "scenes/portrait.gltf"});
}

TEST(Golden, PortraitWithStillDither) {
    check("portrait_dither_still",
          {kAssets + "scenes/portrait.gltf", "--set", "opacity=dither_still"});
}

TEST(Golden, PortraitWithoutShadowsAndEnvironment) {
    check("portrait_bare", {kAssets + "scenes/portrait.gltf", "--set", "shadow=none", "--set",
                            "environment=none", "--set", "multiple=none"});
}

TEST(Golden, Walk) {
    check("walk", {kAssets + "scenes/walk.gltf"});
}

TEST(Golden, Crowd) {
    check("crowd", {kAssets + "scenes/crowd.gltf"});
}

TEST(Golden, Fur) {
    check("fur", {kAssets + "scenes/fur.gltf"});
}

TEST(Golden, BareGroom) {
    check("groom", {kAssets + "grooms/long.hair"});
}

}  // namespace
}  // namespace vellus
