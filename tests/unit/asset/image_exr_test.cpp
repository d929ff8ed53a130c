#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfTiledRgbaFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "tests/unit/asset/test_files.h"

namespace vellus::asset {
namespace {

namespace fs = std::filesystem;

fs::path scratch(const std::string& name) {
    return fs::path(testing::TempDir()) / ("vellus_" + name);
}

std::array<double, 4> sums_of(const ImageF& image) {
    std::array<double, 4> sums{};
    for (size_t i = 0; i < image.rgba.size(); ++i) {
        sums.at(i % 4) += image.rgba[i];
    }
    return sums;
}

struct KnownMeans {
    const char* name;
    std::array<double, 3> rgb;
    bool rings;
};

class ExrFile : public testing::TestWithParam<KnownMeans> {};

// The means are those of ffmpeg 5.1's own decoder (whose DWAB yields squares of floats: their roots
// were summed). OpenEXR rounds to halves, 2^-11 of a value at most, and ffmpeg does not.
TEST_P(ExrFile, HasTheMeansOfAnotherDecoder) {
    VELLUS_ASSET_FILE(path, std::string("hdr/") + GetParam().name + ".exr")
    const auto image = load_image_f(path);
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->width, 1024U);
    EXPECT_EQ(image->height, 512U);
    EXPECT_EQ(image->repairs.not_finite, 0U);
    EXPECT_EQ(image->repairs.negative > 0, GetParam().rings)
        << "only the cosine transform of DWAB rings below zero";
    const auto sums = sums_of(*image);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(sums.at(c) / (1024.0 * 512.0), GetParam().rgb.at(c),
                    5e-4 * GetParam().rgb.at(c))
            << c;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Files, ExrFile,
    testing::Values(KnownMeans{"interior", {1.083039, 0.956132, 0.813178}, true},
                    KnownMeans{"courtyard", {0.637340, 0.510651, 0.525579}, true},
                    KnownMeans{"night", {0.157479, 0.140172, 0.096606}, true},
                    KnownMeans{"OrientationLatLong", {0.876963, 0.914787, 0.957618}, false}),
    [](const auto& param_info) { return std::string(param_info.param.name); });

ImageF ramp(uint32_t width, uint32_t height) {
    ImageF image{width, height, {}, {}};
    for (size_t i = 0; i < size_t{4} * width * height; ++i) {
        image.rgba.push_back(std::ldexp(static_cast<float>(i % 97), static_cast<int>(i % 40) - 20));
    }
    return image;
}

TEST(Exr, WritesFloatsWithoutLossAndWithoutVariation) {
    const ImageF image = ramp(37, 21);
    const auto once = encode_exr(image);
    const auto twice = encode_exr(image);
    ASSERT_TRUE(once && twice);
    EXPECT_EQ(*once, *twice);
    const fs::path path = scratch("ramp.exr");
    ASSERT_TRUE(save_exr(path, image));
    const auto again = load_image_f(path);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->width, 37U);
    EXPECT_EQ(again->height, 21U);
    EXPECT_EQ(again->rgba, image.rgba);
    fs::remove(path);
}

/// Halves of pixel (x, y): 1 + x, 1 + y, 0.25, 1.
std::vector<Imf::Rgba> half_pixels(int width, int height) {
    std::vector<Imf::Rgba> pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            pixels.emplace_back(1.0f + static_cast<float>(x), 1.0f + static_cast<float>(y), 0.25f,
                                1.0f);
        }
    }
    return pixels;
}

TEST(Exr, ReadsTiledHalves) {
    const fs::path path = scratch("tiled.exr");
    const auto pixels = half_pixels(70, 50);
    {
        Imf::TiledRgbaOutputFile file(path.c_str(), 70, 50, 32, 16, Imf::ONE_LEVEL);
        file.setFrameBuffer(pixels.data(), 1, 70);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    const auto image = load_image_f(path);
    ASSERT_TRUE(image) << image.error().message();
    const size_t at = 4 * (33 * 70 + 45);
    EXPECT_EQ(image->rgba[at], 46.0f);
    EXPECT_EQ(image->rgba[at + 1], 34.0f);
    EXPECT_EQ(image->rgba[at + 2], 0.25f);
    fs::remove(path);
}

TEST(Exr, ReadsLuminanceAloneAndWithChroma) {
    const auto pixels = half_pixels(16, 8);
    for (const Imf::RgbaChannels channels : {Imf::WRITE_Y, Imf::WRITE_YC}) {
        const fs::path path = scratch("luminance.exr");
        {
            Imf::RgbaOutputFile file(path.c_str(), 16, 8, channels);
            file.setFrameBuffer(pixels.data(), 1, 16);
            file.writePixels(8);
        }
        const auto image = load_image_f(path);
        ASSERT_TRUE(image) << image.error().message();
        const float* p = image->rgba.data() + 4 * (4 * 16 + 8);
        const float luminance = 0.2126f * 9.0f + 0.7152f * 5.0f + 0.0722f * 0.25f;
        // Halves keep 11 bits; chroma is blurred over 2x2 pixels, which the smooth ramp hardly
        // shows.
        EXPECT_NEAR(0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2], luminance, 0.02f);
        EXPECT_NEAR(p[0], channels == Imf::WRITE_Y ? luminance : 9.0f, 0.2f);
        EXPECT_EQ(p[3], 1.0f);
        fs::remove(path);
    }
}

TEST(Exr, ReadsADataWindowThatDoesNotStartAtZero) {
    const fs::path path = scratch("window.exr");
    const auto pixels = half_pixels(10, 6);
    {
        const Imath::Box2i window({-3, 7}, {6, 12});
        Imf::RgbaOutputFile file(path.c_str(), Imath::Box2i({0, 0}, {31, 31}), window,
                                 Imf::WRITE_RGB);
        file.setFrameBuffer(pixels.data() - (-3 + 7 * 10), 1, 10);
        file.writePixels(6);
    }
    const auto image = load_image_f(path);
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->width, 10U);
    EXPECT_EQ(image->height, 6U);
    EXPECT_EQ(image->rgba[4 * 59], 10.0f);
    EXPECT_EQ(image->rgba[4 * 59 + 1], 6.0f);
    fs::remove(path);
}

TEST(Exr, RepairsAndCountsUnusablePixels) {
    ImageF image{2,
                 1,
                 {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                  -1.0f, 1.0f, -std::numeric_limits<float>::infinity(), 5.0f, 1e30f, 1.0f},
                 {}};
    const auto file = encode_exr(image);
    ASSERT_TRUE(file);
    const auto again = decode_image_f(*file);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->rgba, (std::vector<float>{0, 65504, 0, 1, 0, 5, 1e30f, 1}));
    EXPECT_EQ(again->repairs.not_finite, 3U);
    EXPECT_EQ(again->repairs.negative, 1U);
}

TEST(Exr, RefusesEveryCutOffFile) {
    const auto file = encode_exr(ramp(8, 40));
    ASSERT_TRUE(file);
    for (size_t length = 0; length < file->size(); length += 7) {
        const auto image = decode_exr(std::span(*file).first(length));
        ASSERT_FALSE(image) << length;
        EXPECT_FALSE(image.error().remedy.empty());
    }
}

}  // namespace
}  // namespace vellus::asset
