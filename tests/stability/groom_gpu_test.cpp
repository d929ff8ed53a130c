#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "modules/hair/groom/groom_report.h"
#include "tests/stability/frames.h"

// Row "tangent" of the hard cases from the groom on: what is dropped, skipped, counted and drawn.
namespace vellus::test {
namespace {

constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 64;

using GroomFrames = GpuTest;
using Strands = std::vector<std::vector<glm::vec3>>;

hair::Groom make_groom(const Strands& strands) {
    hair::Groom groom;
    for (const auto& strand : strands) {
        groom.points.insert(groom.points.end(), strand.begin(), strand.end());
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return groom;
}

/// The strands with everything in a file that can be wrong between them.
Strands with_defects(const Strands& strands) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Strands all;
    // Points of no distance to the one before are segments without a length.
    for (const auto& strand : strands) {
        std::vector<glm::vec3>& twice = all.emplace_back();
        for (const glm::vec3& point : strand) {
            twice.push_back(point);
            if (&point == &strand[2] || &point == &strand.back()) twice.push_back(point);
        }
    }
    const glm::vec3 root(0, 0, -0.6f);
    const auto add = [&](std::initializer_list<glm::vec3> rest) {
        std::vector<glm::vec3>& strand = all.emplace_back();
        strand.push_back(root);
        for (const glm::vec3& point : rest) strand.push_back(point);
    };
    add({});
    all.emplace_back();
    add({{kNan, 0, -0.6f}, {0, 0.1f, -0.6f}});
    add({{0, kInfinity, -0.6f}});
    add({{0, 0, -kInfinity}});
    add({root, root});
    return all;
}

Pixels draw(gpu::Device& device, const Strands& strands) {
    TuftScene scene(device, kWidth, kHeight, [&](TuftScene& s) {
        s.world.destroy(s.tuft);
        s.add_hair(rooted_strands(strands, 0.002f), plain_look());
    });
    return scene.draw_frames(3);
}

/// Strands of a groom after its load-time repair.
Strands repaired(const Strands& strands, hair::GroomReport& report) {
    hair::Groom groom = make_groom(strands);
    report = hair::repair(groom);
    Strands left;
    for (size_t s = 0; s < groom.strand_count(); ++s) {
        left.emplace_back(groom.points.begin() + groom.strand_begin[s],
                          groom.points.begin() + groom.strand_begin[s + 1]);
    }
    return left;
}

TEST_F(GroomFrames, DefectsAreCountedAndTheRestIsDrawnAsWithoutThem) {
    const Strands clean = wavy_tuft(200);
    hair::GroomReport report;
    const Strands left = repaired(with_defects(clean), report);
    EXPECT_EQ(report.strands, clean.size());
    EXPECT_EQ(report.short_strands, 2u);
    EXPECT_EQ(report.non_finite_strands, 3u);
    EXPECT_EQ(report.collapsed_strands, 1u);
    EXPECT_EQ(report.zero_segments, 2 * clean.size());
    std::string where = "-";
    const double error = display_error(draw(device(), left), draw(device(), clean), &where);
    report_row({"tangent", "duplicates, 1 point, NaN, Inf: as without", where, error, 0.0});
}

TEST_F(GroomFrames, FoldsAreBounded) {
    Strands folded = wavy_tuft(100);
    for (auto& strand : folded) {
        const std::vector<glm::vec3> there = strand;
        strand.insert(strand.end(), there.rbegin() + 1, there.rend());
    }
    hair::GroomReport report;
    const Strands left = repaired(folded, report);
    EXPECT_EQ(report.folds, folded.size());
    const Pixels picture = draw(device(), left);
    double most = bad_values(picture);
    for (const glm::vec4& pixel : picture) most = std::max(most, double{pixel.g} - 1e3);
    report_row(
        {"tangent", "180 degree folds: finite, bounded", "100 strands", std::max(most, 0.0), 0.0});
}

TEST_F(GroomFrames, StrandsAlongLightAndEyeAreFinite) {
    // Towards the eye, and towards the sun of a TuftScene.
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.3f, 0.6f, 0.8f));
    Strands strands;
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 root(0.008f * static_cast<float>(i) - 0.2f, 0.0f, -0.8f);
        strands.push_back({root, 0.9f * root, 0.8f * root});
        strands.push_back({root, root + 0.05f * to_sun, root + 0.1f * to_sun});
    }
    report_row({"tangent", "T || L, T || V in frames: not finite", "100 strands",
                bad_values(draw(device(), strands)), 0.0});
}

}  // namespace
}  // namespace vellus::test
