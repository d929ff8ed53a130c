#include <gtest/gtest.h>

#include <algorithm>

#include "engine/asset/image_io.h"
#include "engine/asset/image_planes.h"
#include "engine/platform/files.h"
#include "tests/end_to_end/small_groom.h"
#include "tests/support/own_folder.h"
#include "tests/support/process.h"

namespace vellus::demo {
namespace {

namespace fs = std::filesystem;

class ReferenceTest : public testing::Test {
  protected:
    void SetUp() override { groom_ = test::write_small_groom(folder_.path()); }

    std::vector<std::string> command(const fs::path& out, std::vector<std::string> more) {
        std::vector<std::string> arguments = {VELLUS_REFERENCE, groom_,  "--size",
                                              "48x32",          "--out", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    [[nodiscard]] fs::path file(const char* name) const { return folder_.path() / name; }

    test::OwnFolder folder_{"reference"};
    fs::path groom_;
};

TEST_F(ReferenceTest, WritesRadianceWithItsErrorAndTheDisplayedPicture) {
    const auto ended =
        test::run(command(file("a.exr"), {"--spp", "4", "--png", file("a.png"), "--depth", "3"}));
    ASSERT_EQ(ended.status, 0) << ended.output;
    const auto image = asset::load_planes(file("a.exr"));
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->width, 48u);
    EXPECT_EQ(image->height, 32u);
    for (const char* name : {"R", "G", "B", "A", "error.R", "error.G", "error.B", "hair"}) {
        ASSERT_NE(image->find(name), nullptr) << name;
    }
    const auto& hair = image->find("hair")->values;
    EXPECT_EQ(*std::ranges::max_element(hair), 1.0f);
    EXPECT_EQ(*std::ranges::min_element(hair), 0.0f);
    EXPECT_GT(*std::ranges::max_element(image->find("error.G")->values), 0.0f);
    const auto shown = asset::load_image(file("a.png"));
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->width, 48u);
    EXPECT_FALSE(fs::exists(file("a.exr.checkpoint")));
}

TEST_F(ReferenceTest, SameSeedSameFileAnotherSeedAnother) {
    ASSERT_EQ(test::run(command(file("a.exr"), {"--spp", "2"})).status, 0);
    ASSERT_EQ(test::run(command(file("b.exr"), {"--spp", "2"})).status, 0);
    ASSERT_EQ(test::run(command(file("c.exr"), {"--spp", "2", "--seed", "1"})).status, 0);
    EXPECT_EQ(*read_file(file("a.exr")), *read_file(file("b.exr")));
    EXPECT_NE(*read_file(file("a.exr")), *read_file(file("c.exr")));
}

TEST_F(ReferenceTest, StopsOnInterruptAndGoesOnToTheSameBits) {
    test::Process process(command(file("a.exr"), {"--spp", "1000000"}));
    ASSERT_TRUE(process.wait_for("no defects")) << process.output();
    process.interrupt();
    ASSERT_EQ(process.wait(), 130) << process.output();
    EXPECT_TRUE(fs::exists(file("a.exr")));
    ASSERT_TRUE(fs::exists(file("a.exr.checkpoint")));
    const std::string& said = process.output();
    const size_t at = said.find(" has ");
    ASSERT_NE(at, std::string::npos) << said;
    const std::string more = std::to_string(std::stoul(said.substr(at + 5)) + 2);

    const auto resumed = test::run(command(file("a.exr"), {"--spp", more}));
    EXPECT_EQ(resumed.status, 0) << resumed.output;
    EXPECT_NE(resumed.output.find("going on"), std::string::npos) << resumed.output;
    ASSERT_EQ(test::run(command(file("b.exr"), {"--spp", more})).status, 0);
    EXPECT_EQ(*read_file(file("a.exr")), *read_file(file("b.exr")));
    EXPECT_FALSE(fs::exists(file("a.exr.checkpoint")));
}

TEST_F(ReferenceTest, MistakesNameTheOptionFailuresTheFile) {
    const auto expect = [&](std::vector<std::string> more, int status, const std::string& word) {
        const auto ended = test::run(command(file("a.exr"), std::move(more)));
        EXPECT_EQ(ended.status, status) << ended.output;
        EXPECT_NE(ended.output.find(word), std::string::npos) << ended.output;
    };
    expect({"--spp", "0"}, 2, "--spp");
    expect({"--size", "0x3"}, 2, "--size");
    expect({"--out", "picture.png"}, 2, ".exr");
    expect({"--set", "shadow=maybe"}, 2, "shadow");
    expect({"--out", "/proc/none/a.exr"}, 1, "--out");
    const auto missing = test::run({VELLUS_REFERENCE, "no_such.gltf", "--out", file("a.exr")});
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.output.find("no_such.gltf"), std::string::npos) << missing.output;
    ASSERT_TRUE(write_file(file("a.exr.checkpoint"), std::string_view("not one")));
    expect({"--spp", "1"}, 1, "a.exr.checkpoint");
    EXPECT_EQ(test::run({VELLUS_REFERENCE, "--help"}).status, 0);
}

}  // namespace
}  // namespace vellus::demo
