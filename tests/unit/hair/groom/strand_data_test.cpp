#include "modules/hair/groom/strand_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <set>

#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

const glm::dmat4 kIdentity(1.0);

/// What must hold of every StrandData, whatever the groom.
void expect_consistent(const StrandData& data) {
    const size_t strands = data.strand_count();
    ASSERT_EQ(data.strand_begin.size(), strands + 1);
    ASSERT_EQ(data.strand_begin.back(), data.positions.size());
    ASSERT_EQ(data.segment_count(), data.positions.size() - strands);
    ASSERT_EQ(data.point_parameter.size(), data.positions.size());
    std::set<uint32_t> points;
    for (size_t i = 0; i < data.segment_count(); ++i) {
        const uint32_t p = data.segment_point[i];
        const uint32_t strand = data.segment_strand[i];
        EXPECT_GE(p, data.strand_begin[strand]);
        EXPECT_LT(p + 1, data.strand_begin[strand + 1]);
        EXPECT_NE(data.positions[p], data.positions[p + 1]);
        EXPECT_TRUE(points.insert(p).second);
        EXPECT_LE(data.point_parameter[p], data.point_parameter[p + 1]);
    }
    for (size_t s = 0; s < strands; ++s) {
        EXPECT_EQ(data.point_parameter[data.strand_begin[s]], 0);
        EXPECT_EQ(data.point_parameter[data.strand_begin[s + 1] - 1], 65535);
    }
}

TEST(StrandData, EveryStrandAppearsOnceWithItsPoints) {
    std::vector<uint32_t> counts;
    for (uint32_t i = 0; i < 3000; ++i) counts.push_back(2 + i % 7);
    const Groom groom = test::random_groom(counts);
    const StrandData data = prepare_strands(groom, kIdentity, 1e-4f);
    expect_consistent(data);
    ASSERT_EQ(data.strand_count(), counts.size());
    std::vector<uint32_t> sources = data.strand_source;
    std::ranges::sort(sources);
    for (uint32_t i = 0; i < sources.size(); ++i) ASSERT_EQ(sources[i], i);
    for (size_t s = 0; s < data.strand_count(); ++s) {
        const uint32_t source = data.strand_source[s];
        double length = 0.0;
        for (uint32_t i = 0; i < groom.point_count(source); ++i) {
            const uint32_t from = groom.strand_begin[source] + i;
            EXPECT_EQ(data.positions[data.strand_begin[s] + i], groom.points[from]);
            if (i > 0)
                length += glm::distance(glm::dvec3(groom.points[from]),
                                        glm::dvec3(groom.points[from - 1]));
        }
        EXPECT_NEAR(data.strand_length[s], length, 1e-6 * length);
    }
    EXPECT_EQ(data.width, 1e-4f);
    EXPECT_TRUE(data.point_width.empty());
    EXPECT_TRUE(data.point_color.empty());
    EXPECT_FALSE(data.has_color);
    const Bounds box = bounds_of(groom);
    EXPECT_EQ(data.bounds.low, box.low);
    EXPECT_EQ(data.bounds.high, box.high);
}

TEST(StrandData, SortingBringsNeighboursTogether) {
    const Groom groom = test::random_groom(std::vector<uint32_t>(4096, 2));
    const StrandData data = prepare_strands(groom, kIdentity, 1e-4f);
    double sorted = 0.0;
    double unsorted = 0.0;
    for (size_t s = 1; s < data.strand_count(); ++s) {
        sorted += glm::distance(data.positions[2 * s], data.positions[2 * s - 2]);
        unsorted += glm::distance(groom.points[2 * s], groom.points[2 * s - 2]);
    }
    // 4096 roots in a cube: neighbours on the curve are about 1/16 of its edge apart, at random
    // 0.66.
    EXPECT_LT(sorted, 0.25 * unsorted);
}

TEST(StrandData, EachLevelIsABeginningAndARandomPart) {
    const Groom groom = test::random_groom(std::vector<uint32_t>(8000, 3));
    const StrandData data = prepare_strands(groom, kIdentity, 1e-4f);
    ASSERT_EQ(data.levels.size(), kStrandLevels);
    EXPECT_EQ(data.levels[0].strands, 8000u);
    EXPECT_EQ(data.levels[0].points, 24000u);
    EXPECT_EQ(data.levels[0].thicken, 1.0f);
    double total = 0.0;
    for (const float length : data.strand_length) total += length;
    double share = 1.0;
    for (const StrandLevel& level : data.levels) {
        // Four standard deviations of a binomial count.
        EXPECT_NEAR(level.strands, 8000.0 * share, 4.0 * std::sqrt(8000.0 * share) + 1.0);
        EXPECT_EQ(level.points, 3 * level.strands);
        EXPECT_EQ(level.segments, 2 * level.strands);
        double length = 0.0;
        double sources = 0.0;
        for (size_t s = 0; s < level.strands; ++s) {
            length += data.strand_length[s];
            sources += data.strand_source[s];
        }
        EXPECT_NEAR(level.thicken, total / length, 1e-4 * level.thicken);
        // A random part of 0 to 7999 has its mean in the middle: five standard errors.
        EXPECT_NEAR(sources / level.strands, 4000.0, 5.0 * 2310.0 / std::sqrt(level.strands));
        share *= std::sqrt(0.5);
    }
}

TEST(StrandData, CoincidingPointsAreSkippedAndStrandsKept) {
    Groom groom;
    groom.points = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 1, 0},
                    {0, 3, 0}, {0, 3, 0}, {5, 0, 0}, {5, 0, 0}};
    groom.strand_begin = {0, 6, 8};
    const StrandData data = prepare_strands(groom, kIdentity, 1e-4f);
    expect_consistent(data);
    ASSERT_EQ(data.strand_count(), 1u);
    EXPECT_EQ(data.positions, (std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}}));
    EXPECT_EQ(data.point_parameter, (std::vector<uint16_t>{0, 21845, 65535}));
    EXPECT_EQ(data.skipped_segments, 4u);
    EXPECT_EQ(data.max_segment_length, 2.0f);
}

TEST(StrandData, PointsThatFallTogetherInMetresAreSkippedToo) {
    Groom groom;
    groom.points = {{1e6f, 0, 0}, {1e6f, 1e-5f, 0}, {1e6f, 1, 0}};
    groom.strand_begin = {0, 3};
    const StrandData data = prepare_strands(groom, glm::scale(kIdentity, glm::dvec3(1e-5)), 1e-4f);
    expect_consistent(data);
    EXPECT_EQ(data.positions.size(), 2u);
}

TEST(StrandData, TransformTurnsPositionsAndScalesWidths) {
    Groom groom = test::random_groom({3, 2});
    groom.thickness = {0.1f, 0.2f};
    const glm::dmat4 turn = glm::rotate(glm::scale(kIdentity, glm::dvec3(0.01)), 0.7,
                                        glm::normalize(glm::dvec3(1, 2, 3)));
    const StrandData data = prepare_strands(groom, turn, 1e-4f);
    for (size_t s = 0; s < 2; ++s) {
        const uint32_t from = groom.strand_begin[data.strand_source[s]];
        const glm::dvec3 expected(turn * glm::dvec4(groom.points[from], 1.0));
        EXPECT_LT(glm::distance(glm::dvec3(data.positions[data.strand_begin[s]]), expected), 1e-8);
        EXPECT_NEAR(data.point_width[data.strand_begin[s]],
                    0.01f * groom.thickness[data.strand_source[s]], 1e-8);
    }
}

TEST(StrandData, ColoursBecomeLinearHalvesOnlyWhereTheyVary) {
    Groom groom = test::random_groom({2, 2});
    groom.format = GroomFormat::kHair;
    groom.colors.assign(4, {0.5f, 1.0f, 0.0f, 1.0f});
    StrandData data = prepare_strands(groom, kIdentity, 1e-4f);
    EXPECT_TRUE(data.has_color);
    EXPECT_TRUE(data.point_color.empty());
    // IEC 61966-2-1: 0.5 encoded is 0.21404 linear.
    EXPECT_NEAR(data.color.r, 0.21404f, 1e-5f);
    EXPECT_EQ(data.color.g, 1.0f);

    groom.transparency = {0.0f, 0.25f, 0.5f, 1.0f};
    data = prepare_strands(groom, kIdentity, 1e-4f);
    ASSERT_EQ(data.point_color.size(), 4u);
    for (size_t s = 0; s < 2; ++s) {
        for (uint32_t i = 0; i < 2; ++i) {
            const glm::uvec2 packed = data.point_color[2 * s + i];
            const size_t from = size_t{2} * data.strand_source[s] + i;
            EXPECT_NEAR(glm::unpackHalf2x16(packed.x).x, 0.21404f, 2e-4f);
            EXPECT_EQ(glm::unpackHalf2x16(packed.y).y, 1.0f - groom.transparency[from]);
        }
    }
    groom.format = GroomFormat::kGltf;
    EXPECT_EQ(prepare_strands(groom, kIdentity, 1e-4f).color.r, 0.5f);
}

TEST(StrandData, SeedsBelongToTheFilesStrandsAndDiffer) {
    const Groom groom = test::random_groom(std::vector<uint32_t>(1000, 2));
    const StrandData data = prepare_strands(groom, kIdentity, 1e-4f);
    const StrandData turned =
        prepare_strands(groom, glm::rotate(kIdentity, 2.0, glm::dvec3(1, 0, 0)), 1e-4f);
    std::vector<uint32_t> seeds(1000);
    for (size_t s = 0; s < 1000; ++s) seeds[data.strand_source[s]] = data.strand_seed[s];
    for (size_t s = 0; s < 1000; ++s) {
        EXPECT_EQ(turned.strand_seed[s], seeds[turned.strand_source[s]]);
    }
    EXPECT_EQ(std::set<uint32_t>(seeds.begin(), seeds.end()).size(), 1000u);
    double mean = 0.0;
    for (const uint32_t seed : seeds) mean += seed / 4294967296.0 / 1000.0;
    // A uniform mean of 1000 has a standard deviation of 0.0091.
    EXPECT_NEAR(mean, 0.5, 4.0 * 0.0091);
}

TEST(StrandData, NoStrandsMakeEmptyColumns) {
    const StrandData data = prepare_strands(Groom{}, kIdentity, 1e-4f);
    EXPECT_EQ(data.strand_count(), 0u);
    EXPECT_EQ(data.segment_count(), 0u);
    EXPECT_TRUE(data.bounds.empty());
}

}  // namespace
}  // namespace vellus::hair
