#include "modules/hair/groom/groom_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/platform/jobs.h"

namespace vellus::hair {

namespace {

constexpr float kFarthest = 1e9f;
constexpr double kTinySegment = 1e-5;
/// Cosine beyond which two neighbouring segments count as a fold: within 0.8 degrees of 180.
constexpr double kFoldCosine = -0.9999;
constexpr size_t kStrandsPerJob = 256;

enum class Verdict : uint8_t { kKeep, kShort, kNonFinite, kCollapsed };

/// What one look at a strand finds.
struct Finding {
    Verdict verdict = Verdict::kKeep;
    double length = 0.0;
    uint32_t zero_segments = 0;
    uint32_t tiny_segments = 0;
    uint32_t folds = 0;
};

/// Comparisons with NaN are false, so NaN is out of range.
bool usable(glm::vec3 p) {
    return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
}

Finding examine(const Groom& groom, size_t strand) {
    Finding found;
    const uint32_t first = groom.strand_begin[strand];
    const uint32_t last = groom.strand_begin[strand + 1];
    for (uint32_t p = first; p < last; ++p) {
        if (!usable(groom.points[p])) return {.verdict = Verdict::kNonFinite};
    }
    if (last - first < 2) return {.verdict = Verdict::kShort};
    glm::dvec3 before(0.0);
    for (uint32_t p = first; p + 1 < last; ++p) {
        const glm::dvec3 step = glm::dvec3(groom.points[p + 1]) - glm::dvec3(groom.points[p]);
        const double length = glm::length(step);
        found.length += length;
        if (groom.points[p + 1] == groom.points[p]) {
            ++found.zero_segments;
            continue;
        }
        found.tiny_segments += length < kTinySegment ? 1 : 0;
        const double norm = length * glm::length(before);
        found.folds += norm > 0.0 && glm::dot(step, before) < kFoldCosine * norm ? 1 : 0;
        before = step;
    }
    if (found.zero_segments + 1 == last - first) found.verdict = Verdict::kCollapsed;
    return found;
}

void count(const Finding& found, uint32_t points, GroomReport& report) {
    report.short_strands += found.verdict == Verdict::kShort ? 1 : 0;
    report.non_finite_strands += found.verdict == Verdict::kNonFinite ? 1 : 0;
    report.collapsed_strands += found.verdict == Verdict::kCollapsed ? 1 : 0;
    if (found.verdict != Verdict::kKeep) return;
    ++report.strands;
    report.points += points;
    report.zero_segments += found.zero_segments;
    report.tiny_segments += found.tiny_segments;
    report.folds += found.folds;
    report.min_points = std::min(report.min_points, points);
    report.max_points = std::max(report.max_points, points);
    report.min_length = std::min(report.min_length, found.length);
    report.max_length = std::max(report.max_length, found.length);
    report.mean_length += found.length;
}

/// Keeps the values of `kept` strands of a column with one value per strand or per point.
template <class T>
void compact(std::vector<T>& column, const std::vector<Finding>& findings, const Groom& groom) {
    if (column.empty()) return;
    const bool per_point = column.size() == groom.points.size();
    size_t to = 0;
    for (size_t strand = 0; strand < findings.size(); ++strand) {
        if (findings[strand].verdict != Verdict::kKeep) continue;
        const size_t first = per_point ? groom.strand_begin[strand] : strand;
        const size_t last = per_point ? groom.strand_begin[strand + 1] : strand + 1;
        for (size_t from = first; from < last; ++from) column[to++] = column[from];
    }
    column.resize(to);
}

void drop_strands(Groom& groom, const std::vector<Finding>& findings) {
    compact(groom.thickness, findings, groom);
    compact(groom.transparency, findings, groom);
    compact(groom.colors, findings, groom);
    compact(groom.strand_uvs, findings, groom);
    compact(groom.point_uvs, findings, groom);
    compact(groom.inverse_mass, findings, groom);

    std::vector<uint32_t> begin{0};
    std::vector<glm::vec3> points;
    points.reserve(groom.points.size());
    for (size_t strand = 0; strand < findings.size(); ++strand) {
        if (findings[strand].verdict != Verdict::kKeep) continue;
        points.insert(points.end(), groom.points.begin() + groom.strand_begin[strand],
                      groom.points.begin() + groom.strand_begin[strand + 1]);
        begin.push_back(static_cast<uint32_t>(points.size()));
    }
    groom.points = std::move(points);
    groom.strand_begin = std::move(begin);
}

/// Clamps into [low, high]; NaN becomes `low`. Returns whether it changed the value.
bool clamp_value(float& value, float low, float high) {
    if (value >= low && value <= high) return false;
    value = value > high ? high : low;
    return true;
}

uint64_t clamp_attributes(Groom& groom) {
    uint64_t changed = 0;
    const auto clamp_unit = [&](auto& color) {
        for (int channel = 0; channel < color.length(); ++channel) {
            changed += clamp_value(color[channel], 0.0f, 1.0f) ? 1 : 0;
        }
    };
    const auto clamp_uv = [&](glm::vec2& uv) {
        if (std::isfinite(uv.x) && std::isfinite(uv.y)) return;
        uv = glm::vec2(0.0f);
        ++changed;
    };
    for (float& value : groom.thickness) changed += clamp_value(value, 0.0f, kFarthest) ? 1 : 0;
    for (float& value : groom.transparency) changed += clamp_value(value, 0.0f, 1.0f) ? 1 : 0;
    for (float& value : groom.inverse_mass) changed += clamp_value(value, 0.0f, kFarthest) ? 1 : 0;
    for (glm::vec4& color : groom.colors) clamp_unit(color);
    for (glm::vec2& uv : groom.strand_uvs) clamp_uv(uv);
    for (glm::vec2& uv : groom.point_uvs) clamp_uv(uv);
    changed += clamp_value(groom.default_thickness, 0.0f, kFarthest) ? 1 : 0;
    changed += clamp_value(groom.default_transparency, 0.0f, 1.0f) ? 1 : 0;
    clamp_unit(groom.default_color);
    return changed;
}

}  // namespace

GroomReport repair(Groom& groom) {
    std::vector<Finding> findings(groom.strand_count());
    parallel_ranges(findings.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t strand = first; strand < last; ++strand) {
            findings[strand] = examine(groom, strand);
        }
    });
    GroomReport report;
    report.min_points = std::numeric_limits<uint32_t>::max();
    report.min_length = std::numeric_limits<double>::max();
    for (size_t strand = 0; strand < findings.size(); ++strand) {
        count(findings[strand], groom.point_count(strand), report);
    }
    if (report.strands < findings.size()) drop_strands(groom, findings);
    report.segments = report.points - report.strands;
    if (report.strands == 0) {
        report.min_points = 0;
        report.min_length = 0.0;
    } else {
        report.mean_length /= static_cast<double>(report.strands);
    }
    report.bounds = bounds_of(groom);
    report.clamped_attributes = clamp_attributes(groom);
    report.notes = groom.notes;
    return report;
}

std::string to_text(const GroomReport& report) {
    const glm::vec3 low = report.bounds.empty() ? glm::vec3(0.0f) : report.bounds.low;
    const glm::vec3 high = report.bounds.empty() ? glm::vec3(0.0f) : report.bounds.high;
    std::string text = fmt::format(
        "{} strands, {} points ({} to {} a strand), {} segments\n"
        "length {:.4g} to {:.4g}, mean {:.4g}\n"
        "box ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})\n",
        report.strands, report.points, report.min_points, report.max_points, report.segments,
        report.min_length, report.max_length, report.mean_length, low.x, low.y, low.z, high.x,
        high.y, high.z);
    const auto line = [&](uint64_t number, const char* what) {
        if (number > 0) text += fmt::format("{} {}\n", number, what);
    };
    line(report.zero_segments, "zero-length segments: skipped, their strands are kept");
    line(report.tiny_segments, "segments shorter than 1e-5 of the file's unit: kept");
    line(report.folds, "180-degree folds: kept");
    line(report.short_strands, "strands with fewer than two points: dropped");
    line(report.non_finite_strands, "strands with NaN, infinite or huge coordinates: dropped");
    line(report.collapsed_strands, "strands whose points all coincide: dropped");
    line(report.clamped_attributes, "attribute values out of range: clamped");
    for (const std::string& note : report.notes) text += note + "\n";
    if (report.clean()) text += "no defects\n";
    return text;
}

}  // namespace vellus::hair
