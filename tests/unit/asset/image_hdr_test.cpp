#include <gtest/gtest.h>

#include <cmath>

#include "engine/asset/image_io.h"
#include "tests/unit/asset/test_files.h"
#include "tests/unit/asset/tiff_reference.h"

namespace vellus::asset {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

/// Four flat pixels with red 128, 64, 32, 16 at exponent 129: 1, 1/2, 1/4, 1/8.
std::string four_pixels(const std::string& header, const std::string& resolution) {
    std::string file = "#?RADIANCE\n" + header + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
    for (const int red : {128, 64, 32, 16}) {
        file += {static_cast<char>(red), 0, 0, static_cast<char>(129)};
    }
    return file;
}

std::vector<float> reds(const std::string& file) {
    const auto image = decode_hdr(bytes_of(file));
    EXPECT_TRUE(image) << image.error().message();
    std::vector<float> result;
    for (size_t i = 0; i < image->rgba.size(); i += 4) {
        result.push_back(image->rgba[i]);
    }
    return result;
}

class HdrReference : public testing::TestWithParam<const char*> {};

TEST_P(HdrReference, EqualsTheTiffBesideIt) {
    const std::string name = GetParam();
    VELLUS_ASSET_FILE(file, "bad/image-rs-hdr/images/" + name)
    const auto image = load_image_f(file);
    ASSERT_TRUE(image) << image.error().message();
    const auto expected =
        test::read_float_tiff(file.parent_path().parent_path() / "reference" / (name + ".tiff"));
    ASSERT_EQ(image->width, expected.width);
    ASSERT_EQ(image->height, expected.height);
    size_t different = 0;
    for (size_t i = 0; i < expected.rgb.size(); ++i) {
        different += image->rgba[i / 3 * 4 + i % 3] != expected.rgb[i] ? 1U : 0U;
    }
    EXPECT_EQ(different, 0U) << "of " << expected.rgb.size() << " values";
}

INSTANTIATE_TEST_SUITE_P(Files, HdrReference,
                         testing::Values("image1.hdr", "old-rle.hdr", "rgbr4x4.hdr", "scale.hdr"),
                         [](const auto& param_info) {
                             std::string name = param_info.param;
                             for (char& c : name) {
                                 c = std::isalnum(c) != 0 ? c : '_';
                             }
                             return name;
                         });

TEST(Hdr, ReadsTheSunBeyondHalfFloats) {
    VELLUS_ASSET_FILE(file, "hdr/spiaggia_di_mondello_1k.hdr")
    const auto image = load_image_f(file);
    ASSERT_TRUE(image) << image.error().message();
    float sun = 0.0f;
    for (size_t i = 0; i < image->rgba.size(); i += 4) {
        sun = std::max(sun, 0.2126f * image->rgba[i] + 0.7152f * image->rgba[i + 1] +
                                0.0722f * image->rgba[i + 2]);
    }
    // The data's own README says 70,948.
    EXPECT_NEAR(sun, 70948.0f, 1.0f);
}

TEST(Hdr, TurnsEveryOrientationUpright) {
    // File order along the scanlines, seen from the top left of the upright picture.
    EXPECT_EQ(reds(four_pixels("", "-Y 2 +X 2")), (std::vector<float>{1, .5f, .25f, .125f}));
    EXPECT_EQ(reds(four_pixels("", "-Y 2 -X 2")), (std::vector<float>{.5f, 1, .125f, .25f}));
    EXPECT_EQ(reds(four_pixels("", "+Y 2 +X 2")), (std::vector<float>{.25f, .125f, 1, .5f}));
    EXPECT_EQ(reds(four_pixels("", "+Y 2 -X 2")), (std::vector<float>{.125f, .25f, .5f, 1}));
    EXPECT_EQ(reds(four_pixels("", "+X 2 -Y 2")), (std::vector<float>{1, .25f, .5f, .125f}));
    EXPECT_EQ(reds(four_pixels("", "+X 2 +Y 2")), (std::vector<float>{.5f, .125f, 1, .25f}));
    EXPECT_EQ(reds(four_pixels("", "-X 2 -Y 2")), (std::vector<float>{.25f, 1, .125f, .5f}));
    EXPECT_EQ(reds(four_pixels("", "-X 2 +Y 2")), (std::vector<float>{.125f, .5f, .25f, 1}));
}

TEST(Hdr, UndoesExposureAndColorCorrection) {
    const auto image = decode_hdr(
        bytes_of(four_pixels("EXPOSURE=2\nEXPOSURE= 2\nCOLORCORR=0.5 1 1\n", "-Y 2 +X 2")));
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_FLOAT_EQ(image->rgba[0], 1.0f / (2.0f * 2.0f * 0.5f));
}

TEST(Hdr, CoversAll256Exponents) {
    std::string file = "#?RADIANCE\n\n-Y 1 +X 256\n";
    file += {2, 2, 1, 0};
    for (int channel = 0; channel < 3; ++channel) {
        for (int run = 0; run < 4; ++run) {
            file += {static_cast<char>(128 + 64), static_cast<char>(200)};
        }
    }
    for (int start = 0; start < 256; start += 64) {
        file += static_cast<char>(64);
        for (int e = start; e < start + 64; ++e) {
            file += static_cast<char>(e);
        }
    }
    const auto image = decode_hdr(bytes_of(file));
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->rgba[0], 0.0f);
    for (int e = 1; e < 256; ++e) {
        // Powers of two are exact in float (denormal below 2^-126, where 200 x 2^(e-136) still has
        // all its bits).
        EXPECT_EQ(static_cast<double>(image->rgba[4 * static_cast<size_t>(e)]),
                  200.0 * std::pow(2.0, e - 136))
            << e;
    }
    EXPECT_EQ(image->repairs.not_finite, 0U);
}

TEST(Hdr, ConvertsXyzWhiteToWhite) {
    // D65 white in XYZ (0.9505, 1, 1.0891) as mantissas at exponent 129 (x 1/128).
    std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
    file += {static_cast<char>(122), static_cast<char>(128), static_cast<char>(139),
             static_cast<char>(129)};
    const auto image = decode_hdr(bytes_of(file));
    ASSERT_TRUE(image) << image.error().message();
    // An eight-bit mantissa of 122 is off by up to 1/244, the matrix triples that.
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(image->rgba[i], 1.0f, 0.015f);
    }
}

TEST(Hdr, RefusesWhatIsCutOffOrContradictsItself) {
    const std::string whole = four_pixels("", "-Y 2 +X 2");
    for (size_t length = 0; length < whole.size(); ++length) {
        const auto image = decode_hdr(bytes_of(whole.substr(0, length)));
        ASSERT_FALSE(image) << length;
        EXPECT_FALSE(image.error().remedy.empty());
    }
    const std::string head = "#?RADIANCE\n\n";
    for (const std::string& bad :
         {head + "-Y 0 +X 4\n", head + "-Y 4 +Y 4\n", head + "-Y -4 +X 4\n", head + "-Y 4\n",
          head + "\n", head + "-Y 99999 +X 99999\n", head + "-Y 4294967296 +X 4294967296\n",
          head + "-Y 1 +X 4\n" + std::string("\1\1\1\4", 4),        // a run before any pixel
          head + "-Y 1 +X 2\nabcd" + std::string("\1\1\1\xff", 4),  // a run past the scanline
          head + "-Y 1 +X 8\n" +
              std::string("\2\2\0\x08\xff\x01", 6),  // a run past the scanline, new coding
          head + "-Y 1 +X 8\n" + std::string("\2\2\0\x08\0\0", 6),  // a run of nothing
          std::string("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd"),
          std::string("#?RADIANCE\nFORMAT=16-bit\n\n-Y 1 +X 1\nabcd")}) {
        EXPECT_FALSE(decode_hdr(bytes_of(bad))) << bad;
    }
}

TEST(Hdr, WritesWhatItReads) {
    ImageF image{16, 3, {}, {}};
    for (int i = 0; i < 16 * 3; ++i) {
        const float v = std::ldexp(1.0f + static_cast<float>(i) / 48.0f, i - 24);
        image.rgba.insert(image.rgba.end(), {v, v / 3.0f, v / 7.0f, 1.0f});
    }
    const auto file = encode_hdr(image);
    ASSERT_TRUE(file);
    const auto again = decode_hdr(*file);
    ASSERT_TRUE(again) << again.error().message();
    for (size_t i = 0; i < image.rgba.size(); ++i) {
        // The shared exponent leaves the largest channel 7 bits at least; the others lose as much
        // absolutely.
        EXPECT_NEAR(again->rgba[i], image.rgba[i], image.rgba[i / 4 * 4] / 128.0f) << i;
    }
}

}  // namespace
}  // namespace vellus::asset
