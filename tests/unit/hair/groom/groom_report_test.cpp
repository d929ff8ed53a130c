#include "modules/hair/groom/groom_report.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Groom make_groom(const std::vector<std::vector<glm::vec3>>& strands) {
    Groom groom;
    for (const auto& strand : strands) {
        groom.points.insert(groom.points.end(), strand.begin(), strand.end());
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return groom;
}

TEST(GroomReport, CountsLengthsAndBoxOfACleanGroom) {
    Groom groom = make_groom({{{0, 0, 0}, {3, 4, 0}}, {{1, 1, 1}, {1, 1, 2}, {1, 3, 2}}});
    const GroomReport report = repair(groom);
    EXPECT_TRUE(report.clean());
    EXPECT_EQ(report.strands, 2u);
    EXPECT_EQ(report.points, 5u);
    EXPECT_EQ(report.segments, 3u);
    EXPECT_EQ(report.min_points, 2u);
    EXPECT_EQ(report.max_points, 3u);
    EXPECT_DOUBLE_EQ(report.min_length, 3.0);
    EXPECT_DOUBLE_EQ(report.mean_length, 4.0);
    EXPECT_DOUBLE_EQ(report.max_length, 5.0);
    EXPECT_EQ(report.bounds.low, glm::vec3(0.0f));
    EXPECT_EQ(report.bounds.high, glm::vec3(3, 4, 2));
    EXPECT_NE(to_text(report).find("no defects"), std::string::npos);
}

TEST(GroomReport, EachDefectIsCountedOnceAndDealtWith) {
    Groom groom = make_groom({
        {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}},                 // zero segment: kept
        {{5, 5, 5}},                                       // one point: dropped
        {{0, 0, 0}, {kNan, 0, 0}},                         // NaN: dropped
        {{0, 0, 0}, {0, -kInfinity, 0}},                   // infinity: dropped
        {{0, 0, 0}, {0, 2e9f, 0}},                         // beyond 1e9: dropped
        {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}},                 // collapsed: dropped
        {{0, 0, 0}, {0, 1, 0}, {0, 0.5f, 0}, {0, 2, 0}},   // two folds: kept
        {{0, 0, 0}, {1e-6f, 0, 0}, {1, 0, 0}},             // tiny segment: kept
        {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0.25f, 0}},  // a fold across a zero segment
        {},                                                // no points: dropped
    });
    const GroomReport report = repair(groom);
    EXPECT_EQ(report.strands, 4u);
    EXPECT_EQ(groom.strand_count(), 4u);
    EXPECT_EQ(report.zero_segments, 2u);
    EXPECT_EQ(report.short_strands, 2u);
    EXPECT_EQ(report.non_finite_strands, 3u);
    EXPECT_EQ(report.collapsed_strands, 1u);
    EXPECT_EQ(report.folds, 3u);
    EXPECT_EQ(report.tiny_segments, 1u);
    EXPECT_EQ(groom.strand_begin, (std::vector<uint32_t>{0, 3, 7, 10, 14}));
    EXPECT_EQ(groom.points.back(), glm::vec3(0, 0.25f, 0));
    const std::string text = to_text(report);
    for (const char* part : {"zero-length", "fewer than two", "NaN", "coincide", "folds"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    EXPECT_TRUE(repair(groom).non_finite_strands == 0 && repair(groom).strands == 4);
}

TEST(GroomReport, ColumnsStayBesideTheirStrandsAndPoints) {
    Groom groom = test::random_groom({2, 1, 3, 2});
    groom.points[6].x = kNan;  // in the last strand
    for (size_t p = 0; p < groom.points.size(); ++p) {
        const float value = static_cast<float>(p) / 16.0f;
        groom.thickness.push_back(value);
        groom.transparency.push_back(value);
        groom.colors.emplace_back(value);
        groom.point_uvs.emplace_back(value);
        groom.inverse_mass.push_back(value);
    }
    groom.strand_uvs = {glm::vec2(0), glm::vec2(1), glm::vec2(2), glm::vec2(3)};
    repair(groom);
    const std::vector<float> kept = {0.0f, 1 / 16.0f, 3 / 16.0f, 4 / 16.0f, 5 / 16.0f};
    EXPECT_EQ(groom.thickness, kept);
    EXPECT_EQ(groom.transparency, kept);
    EXPECT_EQ(groom.inverse_mass, kept);
    ASSERT_EQ(groom.colors.size(), kept.size());
    EXPECT_EQ(groom.colors[2].r, kept[2]);
    EXPECT_EQ(groom.point_uvs[4].x, kept[4]);
    EXPECT_EQ(groom.strand_uvs, (std::vector<glm::vec2>{glm::vec2(0), glm::vec2(2)}));
}

TEST(GroomReport, AttributesOutOfRangeAreClampedAndCounted) {
    Groom groom = test::random_groom({2});
    groom.thickness = {-1.0f, kNan};
    groom.transparency = {2.0f, 0.5f};
    groom.colors = {{kNan, -1.0f, 7.0f, 1.0f}, {0.5f, 0.5f, 0.5f, 0.5f}};
    groom.strand_uvs = {{kInfinity, 0.0f}};
    const GroomReport report = repair(groom);
    EXPECT_EQ(report.clamped_attributes, 7u);
    EXPECT_EQ(groom.thickness, (std::vector<float>{0, 0}));
    EXPECT_EQ(groom.transparency, (std::vector<float>{1, 0.5f}));
    EXPECT_EQ(groom.colors[0], glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(groom.strand_uvs[0], glm::vec2(0.0f));
}

TEST(GroomReport, NothingLeftIsAnEmptyGroomWithPlainNumbers) {
    Groom groom = make_groom({{{1, 1, 1}}});
    const GroomReport report = repair(groom);
    EXPECT_EQ(groom.strand_begin, std::vector<uint32_t>{0});
    EXPECT_EQ(report.min_length, 0.0);
    EXPECT_EQ(report.min_points, 0u);
    EXPECT_TRUE(report.bounds.empty());
    EXPECT_EQ(to_text(report).find("e+"), std::string::npos);
}

}  // namespace
}  // namespace vellus::hair
