#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "tests/unit/asset/test_files.h"

namespace vellus::asset {
namespace {

namespace fs = std::filesystem;

Image noise(uint32_t width, uint32_t height) {
    std::mt19937 random(7);
    Image image{width, height, {}};
    for (size_t i = 0; i < size_t{4} * width * height; ++i) {
        image.rgba.push_back(static_cast<uint8_t>(random()));
    }
    return image;
}

TEST(Png, WritesAndReadsTheSamePixelsAndBytes) {
    const Image image = noise(33, 17);
    const fs::path path = fs::path(testing::TempDir()) / "vellus_noise.png";
    ASSERT_TRUE(save_png(path, image));
    const auto first = read_file(path);
    ASSERT_TRUE(save_png(path, image));
    const auto second = read_file(path);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(*first, *second);
    const auto again = load_image(path);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->width, 33U);
    EXPECT_EQ(again->height, 17U);
    EXPECT_EQ(again->rgba, image.rgba);
    fs::remove(path);
}

TEST(Png, BecomesLinearLight) {
    Image image{256, 1, {}};
    for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<uint8_t>(code);
        image.rgba.insert(image.rgba.end(), {c, c, c, c});
    }
    const auto file = encode_png(image);
    ASSERT_TRUE(file);
    const auto linear = decode_image_f(*file);
    ASSERT_TRUE(linear) << linear.error().message();
    for (int code = 0; code < 256; ++code) {
        // The inverse transfer function must lead back to the code.
        const double value = linear->rgba[4 * static_cast<size_t>(code)];
        const double encoded =
            value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
        EXPECT_NEAR(encoded * 255.0, code, 1e-3);
        EXPECT_FLOAT_EQ(linear->rgba[4 * static_cast<size_t>(code) + 3],
                        static_cast<float>(code) / 255.0f);
    }
}

TEST(Png, ReadsKnownFiles) {
    VELLUS_ASSET_FILE(folder, "bad/gltf-validator/base/image")
    const auto magenta = load_image(folder / "magenta.png");
    ASSERT_TRUE(magenta) << magenta.error().message();
    EXPECT_EQ((std::vector<uint8_t>(magenta->rgba.begin(), magenta->rgba.begin() + 4)),
              (std::vector<uint8_t>{255, 0, 255, 255}));
    const auto cyan = load_image(folder / "cyan.jpg");
    ASSERT_TRUE(cyan) << cyan.error().message();
    // JPEG rounds in YCbCr.
    EXPECT_NEAR(cyan->rgba[0], 0, 2);
    EXPECT_NEAR(cyan->rgba[1], 255, 2);
    EXPECT_NEAR(cyan->rgba[2], 255, 2);
    for (const char* name :
         {"png_eos.png", "invalid_image_data.jpg", "unrecognized_format.png", "absent.png"}) {
        const auto bad = load_image(folder / name);
        ASSERT_FALSE(bad) << name;
        EXPECT_NE(bad.error().message().find(name), std::string::npos) << bad.error().message();
        EXPECT_FALSE(bad.error().remedy.empty());
    }
}

TEST(Png, RefusesCutOffFilesAndLyingHeaders) {
    const auto file = encode_png(noise(9, 9));
    ASSERT_TRUE(file);
    for (size_t length = 0; length + 12 < file->size();
         ++length) {  // the last 12 bytes only say "end"
        EXPECT_FALSE(decode_image(std::span(*file).first(length))) << length;
    }
    std::vector<std::byte> huge = *file;
    huge[18] = huge[22] = std::byte{0x7f};  // 32512 more pixels each way
    const auto image = decode_image(huge);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message().find("32521x32521"), std::string::npos)
        << image.error().message();
}

TEST(Png, CannotWriteAnEmptyImage) {
    EXPECT_FALSE(encode_png(Image{}));
    EXPECT_FALSE(encode_hdr(ImageF{}));
    EXPECT_FALSE(encode_exr(ImageF{}));
}

}  // namespace
}  // namespace vellus::asset
