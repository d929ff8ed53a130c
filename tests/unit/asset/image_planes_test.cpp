#include "engine/asset/image_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "tests/support/own_folder.h"

namespace vellus::asset {
namespace {

PlaneImage sample() {
    PlaneImage image{3, 2, {}};
    for (const char* name : {"B", "error.R", "R"}) {
        image.planes.push_back({name, {}});
        for (int i = 0; i < 6; ++i) {
            image.planes.back().values.push_back(0.1f * static_cast<float>(i) + name[0]);
        }
    }
    image.planes[1].values[4] = std::numeric_limits<float>::infinity();
    image.planes[1].values[5] = -2.0f;
    return image;
}

TEST(ImagePlanes, ReadBackAsTheyWereWritten) {
    const test::OwnFolder folder("planes");
    const auto file = folder.path() / "a.exr";
    ASSERT_TRUE(save_planes(file, sample()));
    const auto read = load_planes(file);
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->planes.size(), 3u);
    for (const Plane& plane : sample().planes) {
        ASSERT_NE(read->find(plane.name), nullptr);
        EXPECT_EQ(read->find(plane.name)->values, plane.values);
    }
    EXPECT_EQ(read->find("none"), nullptr);
}

TEST(ImagePlanes, OrdinaryReadersSeeTheirColours) {
    const test::OwnFolder folder("planes");
    const auto file = folder.path() / "a.exr";
    ASSERT_TRUE(save_planes(file, sample()));
    const auto image = load_image_f(file);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->rgba[4], sample().planes[2].values[1]);
}

TEST(ImagePlanes, ErrorsNameTheFile) {
    const test::OwnFolder folder("planes");
    const auto file = folder.path() / "a.exr";
    EXPECT_NE(load_planes(file).error().message().find("a.exr"), std::string::npos);
    ASSERT_TRUE(write_file(file, std::string_view("no picture")));
    EXPECT_NE(load_planes(file).error().message().find("a.exr"), std::string::npos);
    ASSERT_TRUE(save_planes(file, sample()));
    auto bytes = *read_file(file);
    bytes.resize(bytes.size() / 2);
    ASSERT_TRUE(write_file(file, std::span<const std::byte>(bytes)));
    EXPECT_FALSE(load_planes(file));
    EXPECT_FALSE(save_planes(folder.path() / "b.exr", {}));
}

}  // namespace
}  // namespace vellus::asset
