#include "game_demo/tools/groom/turntable.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "engine/asset/image_io.h"
#include "game_demo/tools/groom/program.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/grow/grow.h"
#include "tests/support/own_folder.h"

namespace vellus::groom_tool {
namespace {

namespace fs = std::filesystem;

class TurntableTest : public testing::Test {
  protected:
    void SetUp() override {
        hair::GrowSettings settings = hair::preset(hair::GrowStyle::kPonytail);
        settings.count = 400;
        settings.width = 0.0006f;
        const auto head = hair::sphere_surface(glm::vec3(0.0f), 0.09f, false);
        const auto groom = hair::grow_groom(head, settings, 1);
        ASSERT_TRUE(groom);
        turntable_.groom = folder_.path() / "tail.glb";
        ASSERT_TRUE(hair::save_groom(*groom, turntable_.groom));
        turntable_.out = folder_.path() / "out";
        turntable_.views = 4;
        turntable_.frames = 2;
        turntable_.renderer.size = {80, 60};
        turntable_.renderer.validation = true;
        turntable_.sheet = true;
    }
    asset::Image picture(const char* name) {
        auto image = asset::load_image(turntable_.out / name);
        EXPECT_TRUE(image) << name;
        return image ? *image : asset::Image{};
    }
    test::OwnFolder folder_{"turntable"};
    Turntable turntable_;
};

/// Whether a pixel is dark hair before the bright sky.
bool is_hair(const asset::Image& image, size_t x, size_t y) {
    const uint8_t* p = &image.rgba[4 * (y * image.width + x)];
    return p[0] < 90 && p[2] < 90;
}

double mean_x(const asset::Image& image) {
    double sum = 0.0;
    double count = 0.0;
    for (size_t y = 0; y < image.height; ++y) {
        for (size_t x = 0; x < image.width; ++x) {
            if (!is_hair(image, x, y)) continue;
            sum += static_cast<double>(x);
            count += 1.0;
        }
    }
    EXPECT_GT(count, 50.0);
    return sum / count;
}

TEST_F(TurntableTest, LooksFromAllSides) {
    turntable_.color = glm::vec3(0.0f);
    const auto done = write_turntable(turntable_);
    ASSERT_TRUE(done) << done.error().message();
    const asset::Image left = picture("view_01.png");
    const asset::Image right = picture("view_03.png");
    EXPECT_EQ(left.width, 80u);
    EXPECT_EQ(left.height, 60u);
    // From the person's left (+X) the tail, behind, hangs on the right of the picture.
    EXPECT_GT(mean_x(left), mean_x(right) + 2.0);
    const asset::Image sheet = picture("sheet.png");
    EXPECT_EQ(sheet.width, 160u);
    EXPECT_EQ(sheet.height, 120u);
    // The second view is the sheet's upper right quarter.
    for (size_t y = 0; y < 60; ++y) {
        EXPECT_TRUE(std::equal(&left.rgba[4 * 80 * y], &left.rgba[4 * 80 * y] + 4 * 80,
                               &sheet.rgba[4 * (160 * y + 80)]))
            << y;
    }
}

TEST_F(TurntableTest, HangsOnTheNodeOfAScene) {
    turntable_.scene = fs::path(VELLUS_SOURCE_DIR) / "assets" / "scenes" / "portrait.gltf";
    turntable_.node = "hair";
    turntable_.in_node_space = true;
    const auto done = write_turntable(turntable_);
    ASSERT_TRUE(done) << done.error().message();
    picture("view_00.png");
    turntable_.node = "shoulder";
    const auto absent = write_turntable(turntable_);
    ASSERT_FALSE(absent);
    EXPECT_NE(absent.error().message().find("head"), std::string::npos);
}

}  // namespace
}  // namespace vellus::groom_tool
