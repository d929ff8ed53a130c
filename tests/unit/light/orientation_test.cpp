#include <gtest/gtest.h>

#include <filesystem>

#include "engine/asset/image_io.h"
#include "modules/light/light_glsl.h"

namespace vellus::light {
namespace {

/// Darkest luminance near a direction: the map's axes are thin dark lines on white.
float darkest(const asset::ImageF& image, const glm::vec3& direction) {
    const glm::vec2 uv = glsl::equirect_uv(direction);
    const int x = static_cast<int>(uv.x * image.width);
    const int y = static_cast<int>(uv.y * image.height);
    float least = 1e9f;
    for (int dy = -3; dy <= 3; ++dy) {
        for (int dx = -3; dx <= 3; ++dx) {
            const int column =
                (x + dx + static_cast<int>(image.width)) % static_cast<int>(image.width);
            const float* t =
                image.rgba.data() + (static_cast<size_t>(y + dy) * image.width + column) * 4;
            least = std::min(least, std::max(t[0], std::max(t[1], t[2])));
        }
    }
    return least;
}

TEST(Orientation, TheLabelledMapIsNeitherMirroredNorTurned) {
    const std::filesystem::path path =
        std::filesystem::path(VELLUS_TEST_DATA) / "hdr/OrientationLatLong.exr";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const auto image = asset::load_image_f(path);
    ASSERT_TRUE(image) << image.error().message();
    // ILM's map draws the positive axes as black lines from the middle of each side: around +Z,
    // say, +Y goes up and +X to the left, and nothing is drawn towards -X and -Y. Light blue text
    // is never this dark.
    const glm::vec3 up(0, 1, 0);
    for (const glm::vec3 side :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
        const glm::vec3 positive = side.x != 0.0f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
        for (const float step : {0.1f, 0.15f, 0.2f, 0.25f}) {
            EXPECT_LT(darkest(*image, side + step * positive), 0.5f)
                << side.x << " " << side.z << " " << step;
            EXPECT_GT(darkest(*image, side - step * positive), 0.5f)
                << side.x << " " << side.z << " " << step;
            EXPECT_LT(darkest(*image, side + step * up), 0.5f)
                << side.x << " " << side.z << " " << step;
            EXPECT_GT(darkest(*image, side - (step + 0.15f) * up), 0.5f)
                << side.x << " " << side.z << " " << step;
        }
    }
}

}  // namespace
}  // namespace vellus::light
