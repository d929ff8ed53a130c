#include <gtest/gtest.h>

#include <limits>

#include "modules/hair/groom/groom_file.h"
#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

using test::fraction;
using test::overwrite;
using test::put;

constexpr size_t kStrandsAt = 4;
constexpr size_t kPointsAt = 8;
constexpr size_t kBitsAt = 12;
constexpr size_t kSegmentsAt = 16;

/// Two strands of 3 points, or of 2 and 4 where the segments bit is set; value i of an array is
/// fraction(i).
std::vector<std::byte> make_file(uint32_t bits) {
    std::vector<std::byte> bytes;
    put<char>(bytes, {'H', 'A', 'I', 'R'});
    put<uint32_t>(bytes, {2, 6, bits, 2});
    put<float>(bytes, {0.5f, 0.25f, 0.1f, 0.2f, 0.3f});
    bytes.resize(128);
    overwrite(bytes, 40, 'm');
    overwrite(bytes, 41, 'e');
    if (bits & 1U) put<uint16_t>(bytes, {1, 3});
    const auto put_fractions = [&](size_t count) {
        for (size_t i = 0; i < count; ++i) put<float>(bytes, {fraction(i)});
    };
    if (bits & 2U) put_fractions(18);
    if (bits & 4U) put_fractions(6);
    if (bits & 8U) put_fractions(6);
    if (bits & 16U) put_fractions(18);
    return bytes;
}

class HairFileBits : public testing::TestWithParam<uint32_t> {};

TEST_P(HairFileBits, EveryArrayIsFoundWhereTheHeaderSays) {
    const uint32_t bits = GetParam();
    const auto groom = read_hair(make_file(bits), "made");
    if (!(bits & 2U)) {
        ASSERT_FALSE(groom);
        EXPECT_NE(groom.error().message().find("points"), std::string::npos);
        return;
    }
    ASSERT_TRUE(groom) << groom.error().message();
    const std::vector<uint32_t> begin =
        bits & 1U ? std::vector<uint32_t>{0, 2, 6} : std::vector<uint32_t>{0, 3, 6};
    EXPECT_EQ(groom->strand_begin, begin);
    ASSERT_EQ(groom->points.size(), 6u);
    EXPECT_EQ(groom->points[5], glm::vec3(fraction(15), fraction(16), fraction(17)));
    EXPECT_EQ(groom->thickness.size(), bits & 4U ? 6u : 0u);
    EXPECT_EQ(groom->transparency.size(), bits & 8U ? 6u : 0u);
    EXPECT_EQ(groom->colors.size(), bits & 16U ? 6u : 0u);
    EXPECT_EQ(thickness_at(*groom, 1, 5), bits & 4U ? fraction(5) : 0.5f);
    EXPECT_EQ(transparency_at(*groom, 5), bits & 8U ? fraction(5) : 0.25f);
    EXPECT_EQ(glm::vec3(color_at(*groom, 5)),
              bits & 16U ? glm::vec3(fraction(15), fraction(16), fraction(17))
                         : glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(groom->info, "me");
    EXPECT_TRUE(groom->notes.empty());
}

TEST_P(HairFileBits, WhatIsWrittenReadsBackBitForBit) {
    const uint32_t bits = GetParam() | 2U;
    const auto first = read_hair(make_file(bits), "made");
    ASSERT_TRUE(first);
    const auto bytes = write_hair(*first);
    ASSERT_TRUE(bytes);
    const std::vector<std::byte> made = make_file(bits);
    ASSERT_EQ(bytes->size(), made.size());
    for (size_t i = 0; i < made.size(); ++i) {
        // The default segment count says nothing where the segments are listed.
        if ((bits & 1U) && i >= kSegmentsAt && i < kSegmentsAt + 4) continue;
        EXPECT_EQ((*bytes)[i], made[i]) << "byte " << i;
    }
}

TEST_P(HairFileBits, TruncatedAnywhereIsAnError) {
    const auto whole = make_file(GetParam() | 2U);
    for (size_t size = 0; size < whole.size(); ++size) {
        const auto groom = read_hair(std::span(whole).first(size), "cut.hair");
        ASSERT_FALSE(groom) << size;
        EXPECT_NE(groom.error().message().find("cut.hair"), std::string::npos);
    }
}

INSTANTIATE_TEST_SUITE_P(AllBits, HairFileBits, testing::Range(0u, 32u));

TEST(HairFile, UnknownBitsAndTrailingBytesAreNoted) {
    auto bytes = make_file(2U | 64U);
    bytes.resize(bytes.size() + 5);
    const auto groom = read_hair(bytes, "made");
    ASSERT_TRUE(groom);
    ASSERT_EQ(groom->notes.size(), 2u);
    EXPECT_NE(groom->notes[0].find("0x40"), std::string::npos);
    EXPECT_NE(groom->notes[1].find("5 bytes"), std::string::npos);
}

TEST(HairFile, CountsBeyondTheFileAreRefusedBeforeAllocating) {
    for (const uint32_t huge : {7u, 1000u, 0x55555555u, 0x80000000u, 0xFFFFFFFFu}) {
        for (const size_t field : {kStrandsAt, kPointsAt, kSegmentsAt}) {
            for (uint32_t bits = 2; bits < 32; bits = (bits + 1) | 2U) {
                auto bytes = make_file(bits);
                overwrite(bytes, field, huge);
                if (field == kSegmentsAt && (bits & 1U)) continue;
                EXPECT_FALSE(read_hair(bytes, "made")) << field << " " << huge << " " << bits;
            }
        }
    }
}

TEST(HairFile, SegmentsThatDoNotAddUpAreRefused) {
    auto bytes = make_file(3);
    overwrite(bytes, 128, uint16_t{0});
    const auto groom = read_hair(bytes, "made");
    ASSERT_FALSE(groom);
    EXPECT_NE(groom.error().message().find("needs 5 points, header says 6"), std::string::npos)
        << groom.error().message();
}

TEST(HairFile, NoStrandsIsAnEmptyGroom) {
    std::vector<std::byte> bytes = make_file(2);
    overwrite(bytes, kStrandsAt, 0u);
    overwrite(bytes, kPointsAt, 0u);
    bytes.resize(128);
    const auto groom = read_hair(bytes, "made");
    ASSERT_TRUE(groom) << groom.error().message();
    EXPECT_EQ(groom->strand_count(), 0u);
    EXPECT_EQ(write_hair(*groom)->size(), 128u);
}

TEST(HairFile, StrandTooLongForTheFormatIsRefusedOnWriting) {
    EXPECT_TRUE(write_hair(test::random_groom({65536, 2})));
    const auto refused = write_hair(test::random_groom({2, 65537}));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message().find("strand 1 has 65537 points"), std::string::npos);
}

TEST(HairFile, BlackOrWhiteByDefaultIsNoColour) {
    for (const float value : {0.0f, 1.0f, 0.5f}) {
        auto bytes = make_file(2);
        for (size_t channel = 0; channel < 3; ++channel) overwrite(bytes, 28 + 4 * channel, value);
        const auto groom = read_hair(bytes, "made");
        ASSERT_TRUE(groom);
        EXPECT_EQ(groom->has_default_color, value == 0.5f);
        EXPECT_EQ(has_colors(*groom), value == 0.5f);
        EXPECT_EQ(*write_hair(*groom), bytes);
    }
}

TEST(HairFile, NonFiniteNumbersSurviveReadingAndWriting) {
    auto bytes = make_file(2);
    overwrite(bytes, 128, std::numeric_limits<float>::quiet_NaN());
    overwrite(bytes, 132, -std::numeric_limits<float>::infinity());
    const auto groom = read_hair(bytes, "made");
    ASSERT_TRUE(groom);
    EXPECT_EQ(*write_hair(*groom), bytes);
}

}  // namespace
}  // namespace vellus::hair
