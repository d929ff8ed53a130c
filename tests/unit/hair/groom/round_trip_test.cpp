#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/asset/gltf.h"
#include "engine/platform/files.h"
#include "modules/hair/groom/convert.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/upright.h"
#include "tests/support/own_folder.h"

namespace vellus::hair {
namespace {

/// A groom with a random choice of columns and random numbers in them.
Groom any_groom(uint32_t seed) {
    std::mt19937 random(seed);
    const auto chance = [&] { return random() % 2 == 0; };
    const auto number = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    constexpr GroomFormat kFormats[] = {GroomFormat::kHair, GroomFormat::kTfx4, GroomFormat::kGltf};
    Groom groom;
    groom.format = kFormats[random() % 3];
    const size_t strands = 1 + random() % 9;
    const bool even = chance();
    const uint32_t common = 2 + random() % 14;
    const float size = groom.format == GroomFormat::kHair ? 10.0f : 0.1f;
    for (size_t s = 0; s < strands; ++s) {
        const uint32_t points = even ? common : 2 + random() % 14;
        for (uint32_t p = 0; p < points; ++p) {
            groom.points.emplace_back(number(-size, size), number(-size, size),
                                      number(-size, size));
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    const size_t points = groom.points.size();
    if (chance()) groom.thickness.resize(chance() ? points : strands);
    for (float& t : groom.thickness) t = number(1e-5f, 1e-3f);
    if (groom.thickness.empty() && chance()) groom.default_thickness = number(1e-5f, 1e-3f);
    if (chance()) groom.colors.resize(points);
    for (glm::vec4& c : groom.colors) {
        c = {number(0, 1), number(0, 1), number(0, 1), chance() ? 1.0f : number(0, 1)};
    }
    if (chance() && groom.format == GroomFormat::kHair) groom.transparency.resize(points);
    for (float& t : groom.transparency) t = number(0, 1);
    if (chance()) groom.strand_uvs.resize(strands);
    for (glm::vec2& uv : groom.strand_uvs) uv = {number(0, 1), number(-2, 2)};
    if (chance()) groom.point_uvs.resize(points);
    for (glm::vec2& uv : groom.point_uvs) uv = {number(0, 1), number(-2, 2)};
    if (chance()) {
        groom.has_default_color = true;
        groom.default_color = {number(0, 1), number(0, 1), number(0, 1)};
    }
    if (chance()) groom.info = "grown on a test bench";
    return groom;
}

void expect_same(const Groom& a, const Groom& b) {
    EXPECT_EQ(a.format, b.format);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.strand_begin, b.strand_begin);
    EXPECT_EQ(a.thickness, b.thickness);
    EXPECT_EQ(a.transparency, b.transparency);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.strand_uvs, b.strand_uvs);
    EXPECT_EQ(a.point_uvs, b.point_uvs);
    EXPECT_EQ(a.inverse_mass, b.inverse_mass);
    EXPECT_EQ(a.default_thickness, b.default_thickness);
    EXPECT_EQ(a.default_transparency, b.default_transparency);
    EXPECT_EQ(a.default_color, b.default_color);
    EXPECT_EQ(a.has_default_color, b.has_default_color);
    EXPECT_EQ(a.info, b.info);
}

struct Written {
    GroomFormat format;
    const char* extension;
};

class RoundTrip : public testing::TestWithParam<Written> {
  protected:
    test::OwnFolder folder_{"round_trip"};
};

TEST_P(RoundTrip, WhatWasWrittenReadsBackBitForBit) {
    const auto path = folder_.path() / (std::string("groom") + GetParam().extension);
    for (uint32_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Groom source = any_groom(seed);
        if (GetParam().format == GroomFormat::kTfx4) source = resample_groom(source, 7);
        const Groom groom = convert_groom(source, GetParam().format).groom;
        ASSERT_TRUE(save_groom(groom, path));
        const auto loaded = load_groom(path);
        ASSERT_TRUE(loaded) << loaded.error().message();
        expect_same(loaded->groom, groom);
        if (HasFailure()) return;
    }
}

TEST_P(RoundTrip, ConvertingTwiceChangesNothingMore) {
    for (uint32_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const Groom once = convert_groom(any_groom(seed), GetParam().format).groom;
        const ConvertedGroom twice = convert_groom(once, GetParam().format);
        expect_same(twice.groom, once);
        EXPECT_TRUE(twice.notes.empty()) << twice.notes.front();
        if (HasFailure()) return;
    }
}

TEST_P(RoundTrip, AFailedWriteLeavesTheOldFile) {
    const auto path = folder_.path() / (std::string("groom") + GetParam().extension);
    const Groom groom = convert_groom(resample_groom(any_groom(3), 4), GetParam().format).groom;
    ASSERT_TRUE(save_groom(groom, path));
    const auto before = read_file(path);
    ASSERT_TRUE(before);
    Groom broken = groom;
    // No format holds a strand without points.
    broken.strand_begin.insert(broken.strand_begin.begin(), 0);
    EXPECT_FALSE(save_groom(broken, path));
    const auto after = read_file(path);
    ASSERT_TRUE(after);
    EXPECT_EQ(*before, *after);
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        static_cast<void>(entry);
        ++files;
    }
    EXPECT_EQ(files, 1u) << "nothing temporary stays behind";
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         testing::Values(Written{GroomFormat::kHair, ".hair"},
                                         Written{GroomFormat::kTfx4, ".tfx"},
                                         Written{GroomFormat::kGltf, ".glb"}),
                         [](const auto& tested) {
                             return std::string(tested.param.extension + 1);
                         });

TEST(ConvertGroom, MetresAndUpStayWhatTheyAreAcrossFormats) {
    // A head's worth of hair that hangs: unit and axes are clear in each format.
    Groom groom;
    groom.format = GroomFormat::kGltf;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-0.08f, 0.08f);
    for (int s = 0; s < 200; ++s) {
        // The hairline is higher in front, which is how .hair files tell the face.
        const float back = at(random);
        const glm::vec3 root(at(random), 0.05f - 0.8f * back, -back);
        for (int p = 0; p < 6; ++p) {
            groom.points.push_back(root + glm::vec3(0.002f * p, -0.05f * p, 0.004f * p));
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    groom.default_thickness = 1e-4f;
    for (const GroomFormat target : {GroomFormat::kHair, GroomFormat::kTfx4}) {
        const Groom there = convert_groom(groom, target).groom;
        const Groom back = convert_groom(there, GroomFormat::kGltf).groom;
        ASSERT_EQ(back.points.size(), groom.points.size());
        for (size_t p = 0; p < groom.points.size(); ++p) {
            // Two roundings of coordinates of at most 0.4 m.
            EXPECT_LT(glm::distance(back.points[p], groom.points[p]), 2e-7f);
        }
        EXPECT_NEAR(thickness_at(back, 0, 0), 1e-4f, 1e-10f);
    }
}

TEST(ConvertGroom, ColoursChangeTheirEncodingNotTheirLook) {
    Groom groom;
    groom.format = GroomFormat::kGltf;
    groom.points = {{0, 0, 0}, {0, 0.1f, 0}};
    groom.strand_begin = {0, 2};
    groom.colors = {{0.0f, 0.002f, 0.2f, 0.5f}, {0.5f, 0.9f, 1.0f, 1.0f}};
    const Groom tfx = convert_groom(groom, GroomFormat::kTfx4).groom;
    // sRGB of 0.2 by the standard's formula.
    EXPECT_NEAR(tfx.colors[0].b, 1.055 * std::pow(0.2, 1.0 / 2.4) - 0.055, 1e-6);
    for (size_t p = 0; p < 2; ++p) {
        const glm::vec4 linear = linear_color_at(tfx, p);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(linear[c], groom.colors[p][c], 1e-6f) << p << c;
    }
}

TEST(ConvertGroom, NamesWhatTheFormatCannotHold) {
    Groom groom = any_groom(1);
    groom.format = GroomFormat::kTfx4;
    groom.strand_uvs.assign(groom.strand_count(), glm::vec2(0.5f));
    groom.inverse_mass.assign(groom.points.size(), 1.0f);
    const auto notes = convert_groom(groom, GroomFormat::kHair).notes;
    const auto mentions = [&](const char* word) {
        return std::ranges::any_of(
            notes, [&](const std::string& n) { return n.find(word) != std::string::npos; });
    };
    EXPECT_TRUE(mentions("texture coordinates"));
    EXPECT_TRUE(mentions("held"));
}

TEST(ResampleGroom, KeepsEndsAndSpacesEvenly) {
    Groom groom;
    // A right angle: lengths 1 and 3.
    groom.points = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}};
    groom.strand_begin = {0, 3};
    groom.thickness = {4.0f, 2.0f, 1.0f};
    const Groom five = resample_groom(groom, 5);
    const std::vector<glm::vec3> expected = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 2, 0}, {1, 3, 0}};
    ASSERT_EQ(five.points.size(), 5u);
    for (size_t p = 0; p < 5; ++p) EXPECT_LT(glm::distance(five.points[p], expected[p]), 1e-6f);
    EXPECT_FLOAT_EQ(five.thickness[0], 4.0f);
    EXPECT_FLOAT_EQ(five.thickness[1], 2.0f);
    EXPECT_FLOAT_EQ(five.thickness[2], 2.0f - 1.0f / 3.0f);
    EXPECT_FLOAT_EQ(five.thickness[4], 1.0f);
}

}  // namespace
}  // namespace vellus::hair
