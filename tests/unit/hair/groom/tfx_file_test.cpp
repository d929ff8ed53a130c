#include <gtest/gtest.h>

#include "modules/hair/groom/groom_file.h"
#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

using test::fraction;
using test::overwrite;
using test::put;

constexpr uint32_t kStrands = 3;
constexpr uint32_t kPerStrand = 4;
constexpr uint32_t kPoints = kStrands * kPerStrand;

/// Which of the optional arrays a made file has: strand UV, point UV, thickness, colour.
enum Arrays : uint32_t { kStrandUv = 1, kPointUv = 2, kThickness = 4, kColor = 8 };

struct MadeFile {
    std::vector<std::byte> bytes;
    /// Puts the next array at the end and its offset into the header.
    void append(size_t offset_at, size_t floats, float shift) {
        overwrite(bytes, offset_at, static_cast<uint32_t>(bytes.size()));
        for (size_t i = 0; i < floats; ++i) put<float>(bytes, {fraction(i) + shift});
    }
};

/// Value i of array number n is fraction(i) + n. Offsets as the headers of AMD's exporters have
/// them.
std::vector<std::byte> make_file(float version, uint32_t arrays) {
    MadeFile file;
    const bool three = version < 4.0f;
    file.bytes.resize(three ? 296 : 160);
    overwrite(file.bytes, 0, version);
    overwrite(file.bytes, 4, kStrands);
    overwrite(file.bytes, 8, kPerStrand);
    file.append(three ? 144 : 12, size_t{kPoints} * (three ? 3 : 4), 0.0f);
    if (arrays & kStrandUv) file.append(three ? 152 : 16, size_t{kStrands} * 2, 1.0f);
    if (arrays & kPointUv) file.append(three ? 164 : 20, size_t{kPoints} * 2, 2.0f);
    if (arrays & kThickness) file.append(three ? 148 : 24, kStrands, 3.0f);
    if (arrays & kColor) file.append(three ? 156 : 28, size_t{kPoints} * 4, 4.0f);
    return file.bytes;
}

class TfxFile : public testing::TestWithParam<std::tuple<float, uint32_t>> {};

TEST_P(TfxFile, EveryArrayIsFoundWhereTheHeaderSays) {
    const auto [version, arrays] = GetParam();
    const bool three = version < 4.0f;
    const auto groom = read_tfx(make_file(version, arrays), "made");
    ASSERT_TRUE(groom) << groom.error().message();
    EXPECT_EQ(groom->format, three ? GroomFormat::kTfx3 : GroomFormat::kTfx4);
    EXPECT_EQ(groom->strand_begin, (std::vector<uint32_t>{0, 4, 8, 12}));
    const size_t stride = three ? 3 : 4;
    for (size_t p = 0; p < kPoints; ++p) {
        EXPECT_EQ(groom->points[p], glm::vec3(fraction(p * stride), fraction(p * stride + 1),
                                              fraction(p * stride + 2)));
        if (!three) {
            EXPECT_EQ(groom->inverse_mass[p], fraction(p * stride + 3));
        }
    }
    ASSERT_EQ(groom->strand_uvs.size(), arrays & kStrandUv ? kStrands : 0);
    ASSERT_EQ(groom->point_uvs.size(), arrays & kPointUv ? kPoints : 0);
    ASSERT_EQ(groom->thickness.size(), arrays & kThickness ? kStrands : 0);
    ASSERT_EQ(groom->colors.size(), arrays & kColor ? kPoints : 0);
    if (arrays & kStrandUv) {
        EXPECT_EQ(groom->strand_uvs[2].y, fraction(5) + 1.0f);
    }
    if (arrays & kPointUv) {
        EXPECT_EQ(groom->point_uvs[11].y, fraction(23) + 2.0f);
    }
    if (arrays & kThickness) {
        EXPECT_EQ(thickness_at(*groom, 2, 9), fraction(2) + 3.0f);
    }
    if (arrays & kColor) {
        EXPECT_EQ(groom->colors[11].a, fraction(47) + 4.0f);
    }
}

TEST_P(TfxFile, WhatIsWrittenReadsBackTheSame) {
    const auto [version, arrays] = GetParam();
    auto first = read_tfx(make_file(version, arrays), "made");
    ASSERT_TRUE(first);
    const auto bytes = write_tfx(*first);
    ASSERT_TRUE(bytes) << bytes.error().message();
    const auto again = read_tfx(*bytes, "written");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->points, first->points);
    EXPECT_EQ(again->strand_begin, first->strand_begin);
    EXPECT_EQ(again->strand_uvs, first->strand_uvs);
    EXPECT_EQ(again->point_uvs, first->point_uvs);
    EXPECT_EQ(again->thickness, first->thickness);
    EXPECT_EQ(again->colors, first->colors);
    if (version >= 4.0f) {
        EXPECT_EQ(again->inverse_mass, first->inverse_mass);
    } else {
        EXPECT_EQ(again->inverse_mass, (std::vector<float>{0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1}));
    }
}

TEST_P(TfxFile, TruncatedAnywhereIsAnError) {
    const auto [version, arrays] = GetParam();
    const auto whole = make_file(version, arrays);
    for (size_t size = 0; size < whole.size(); ++size) {
        ASSERT_FALSE(read_tfx(std::span(whole).first(size), "cut.tfx")) << size;
    }
}

TEST_P(TfxFile, HostileHeaderWordsAreRefusedBeforeAllocating) {
    const auto [version, arrays] = GetParam();
    const size_t header = version < 4.0f ? 296 : 160;
    for (const uint32_t word : {1u, 100u, 0x10000000u, 0x40000000u, 0x80000000u, 0xFFFFFFFFu}) {
        for (size_t at = 4; at < header; at += 4) {
            auto bytes = make_file(version, arrays);
            overwrite(bytes, at, word);
            const auto groom = read_tfx(bytes, "hostile");
            // Reserved words, 3.x's simulation fields and smaller counts may pass; never more
            // points than the file has bytes for.
            if (groom) {
                EXPECT_LE(groom->points.size() * 12, bytes.size());
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Versions, TfxFile,
                         testing::Combine(testing::Values(3.0f, 3.1f, 4.0f, 4.1f),
                                          testing::Range(0u, 16u)));

TEST(TfxFileErrors, VersionsOutsideThreeAndFourAreNamed) {
    for (const float version : {0.0f, 2.0f, 2.99f, 5.0f, -4.0f, 1e30f}) {
        const auto groom = read_tfx(make_file(version, 0), "old.tfx");
        ASSERT_FALSE(groom) << version;
    }
    EXPECT_NE(read_tfx(make_file(2.0f, 0), "old.tfx").error().message().find("version 2"),
              std::string::npos);
}

TEST(TfxFileErrors, StrandsWithoutPointsAndWithoutPositionsAreRefused) {
    auto bytes = make_file(4.0f, 0);
    overwrite(bytes, 8, 0u);
    EXPECT_NE(read_tfx(bytes, "made").error().message().find("no points"), std::string::npos);
    bytes = make_file(4.0f, 0);
    overwrite(bytes, 12, 0u);
    EXPECT_NE(read_tfx(bytes, "made").error().message().find("positions"), std::string::npos);
}

TEST(TfxFileErrors, StrandsOfDifferentLengthCannotBeWritten) {
    const auto bytes = write_tfx(test::random_groom({4, 4, 5}));
    ASSERT_FALSE(bytes);
    EXPECT_NE(bytes.error().message().find("strand 2 has 5"), std::string::npos);
}

TEST(TfxFileErrors, NoStrandsIsAnEmptyGroom) {
    const auto bytes = write_tfx(Groom{});
    ASSERT_TRUE(bytes);
    const auto groom = read_tfx(*bytes, "empty");
    ASSERT_TRUE(groom) << groom.error().message();
    EXPECT_EQ(groom->strand_count(), 0u);
}

}  // namespace
}  // namespace vellus::hair
