#include "modules/hair/cards/ribbon_detail.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vellus::hair::detail {

namespace {

struct Moments {
    double count = 0.0;
    glm::dvec2 sum{0.0};
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;

    void add(glm::dvec2 p) {
        count += 1.0;
        sum += p;
        xx += p.x * p.x;
        xy += p.x * p.y;
        yy += p.y * p.y;
    }
    /// Direction of the principal axis with its angle doubled, longer the more it matters (square
    /// metres): opposite axes are the same axis, so only doubled angles can be averaged.
    [[nodiscard]] glm::dvec2 doubled_axis() const {
        if (count < 2.0) return glm::dvec2(0.0);
        const glm::dvec2 mean = sum / count;
        const double cxx = xx / count - mean.x * mean.x;
        const double cxy = xy / count - mean.x * mean.y;
        const double cyy = yy / count - mean.y * mean.y;
        return {cxx - cyy, 2.0 * cxy};
    }
};

uint32_t nearest_row(const RibbonPoint& at) {
    return at.interval + (at.t >= 0.5f ? 1 : 0);
}

template <class T>
void smooth_all(std::vector<T>& values, int passes) {
    std::vector<T> next(values.size());
    for (int pass = 0; pass < passes; ++pass) {
        for (size_t i = 0; i < values.size(); ++i) {
            const T& before = values[i > 0 ? i - 1 : 0];
            const T& after = values[std::min(i + 1, values.size() - 1)];
            next[i] = (before + values[i] + values[i] + after) / typename T::value_type(4);
        }
        values.swap(next);
    }
}

/// Cross-sections may come together to this share of their distance on the line.
constexpr float kNearestSections = 0.3f;

std::vector<glm::vec3> directions(const std::vector<glm::vec3>& line) {
    std::vector<glm::vec3> along(line.size());
    for (size_t i = 0; i < line.size(); ++i) {
        const glm::vec3 d = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
        along[i] = d / std::max(glm::length(d), 1e-12f);
    }
    return along;
}

/// Whether the cross-section of point i comes too near the next one's within the radius.
bool crowded(const std::vector<glm::vec3>& line, const std::vector<glm::vec3>& along,
             std::span<const float> radius, size_t i) {
    const float turn = glm::length(along[i + 1] - along[i]);
    const float step = glm::distance(line[i + 1], line[i]);
    return std::max(radius[i], radius[i + 1]) * turn > (1.0f - kNearestSections) * step;
}

void turn(RibbonRow& row, double angle) {
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    const glm::vec3 across = c * row.across + s * row.toward;
    row.toward = c * row.toward - s * row.across;
    row.across = across;
}

/// The farthest centre from the chord between rows a and b, and how far it is.
std::pair<uint32_t, float> farthest_from_chord(const Ribbon& ribbon, uint32_t a, uint32_t b) {
    const glm::vec3 start = ribbon.rows[a].center;
    const glm::vec3 chord = ribbon.rows[b].center - start;
    const float squared = std::max(glm::dot(chord, chord), 1e-20f);
    std::pair<uint32_t, float> farthest{a, -1.0f};
    for (uint32_t i = a + 1; i < b; ++i) {
        const glm::vec3 offset = ribbon.rows[i].center - start;
        const float t = std::clamp(glm::dot(offset, chord) / squared, 0.0f, 1.0f);
        const float distance = glm::length(offset - chord * t);
        if (distance > farthest.second) farthest = {i, distance};
    }
    return farthest;
}

void keep_between(const Ribbon& ribbon, uint32_t a, uint32_t b, float tolerance, uint32_t longest,
                  std::vector<uint32_t>& kept) {
    auto [split, distance] = farthest_from_chord(ribbon, a, b);
    if (distance <= tolerance) {
        if (b - a <= longest) return;
        split = (a + b) / 2;
    }
    keep_between(ribbon, a, split, tolerance, longest, kept);
    kept.push_back(split);
    keep_between(ribbon, split, b, tolerance, longest, kept);
}

}  // namespace

glm::vec3 any_perpendicular(glm::vec3 axis) {
    const glm::vec3 other = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(axis, other));
}

void smooth(std::vector<glm::vec3>& line, int passes) {
    const glm::vec3 first = line.front();
    const glm::vec3 last = line.back();
    for (int pass = 0; pass < passes; ++pass) {
        smooth_all(line, 1);
        line.front() = first;
        line.back() = last;
    }
}

float crowded_turn(const std::vector<glm::vec3>& line, std::span<const float> radius) {
    const std::vector<glm::vec3> along = directions(line);
    float sum = 0.0f;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        if (!crowded(line, along, radius, i)) continue;
        sum += std::acos(std::clamp(glm::dot(along[i], along[i + 1]), -1.0f, 1.0f));
    }
    return sum;
}

bool straighten(std::vector<glm::vec3>& line, std::span<const float> radius, int passes) {
    constexpr size_t kAround = 2;
    std::vector<glm::vec3> smoothed;
    for (int pass = 0; pass < passes; ++pass) {
        const std::vector<glm::vec3> along = directions(line);
        std::vector<uint8_t> chosen(line.size(), 0);
        for (size_t i = 0; i + 1 < line.size(); ++i) {
            if (!crowded(line, along, radius, i)) continue;
            const size_t end = std::min(i + kAround + 2, line.size());
            for (size_t k = i - std::min(i, kAround); k < end; ++k) chosen[k] = 1;
        }
        if (std::ranges::find(chosen, 1) == chosen.end()) return pass > 0;
        smoothed = line;
        smooth_all(smoothed, 1);
        for (size_t i = 0; i < line.size(); ++i) {
            if (chosen[i] != 0) line[i] = smoothed[i];
        }
    }
    return true;
}

void update_along(Ribbon& ribbon) {
    std::vector<RibbonRow>& rows = ribbon.rows;
    for (size_t i = 0; i < rows.size(); ++i) {
        const glm::vec3 before = rows[i > 0 ? i - 1 : 0].center;
        const glm::vec3 after = rows[std::min(i + 1, rows.size() - 1)].center;
        const glm::vec3 d = after - before;
        const float length = glm::length(d);
        rows[i].along = length > 1e-12f ? d / length
                        : i > 0         ? rows[i - 1].along
                                        : glm::vec3(0, 1, 0);
        rows[i].distance =
            i > 0 ? rows[i - 1].distance + glm::distance(rows[i].center, before) : 0.0f;
    }
}

Ribbon transport_frames(const std::vector<glm::vec3>& centers) {
    Ribbon ribbon;
    for (const glm::vec3 center : centers) ribbon.rows.push_back({.center = center});
    update_along(ribbon);
    std::vector<RibbonRow>& rows = ribbon.rows;
    rows[0].across = any_perpendicular(rows[0].along);
    for (size_t i = 0; i + 1 < rows.size(); ++i) {
        const glm::vec3 v1 = rows[i + 1].center - rows[i].center;
        const float c1 = std::max(glm::dot(v1, v1), 1e-20f);
        const glm::vec3 across = rows[i].across - v1 * (2.0f / c1 * glm::dot(v1, rows[i].across));
        const glm::vec3 along = rows[i].along - v1 * (2.0f / c1 * glm::dot(v1, rows[i].along));
        const glm::vec3 v2 = rows[i + 1].along - along;
        const float c2 = glm::dot(v2, v2);
        glm::vec3 next = c2 > 1e-12f ? across - v2 * (2.0f / c2 * glm::dot(v2, across)) : across;
        next -= rows[i + 1].along * glm::dot(next, rows[i + 1].along);
        const float length = glm::length(next);
        rows[i + 1].across = length > 1e-6f ? next / length : any_perpendicular(rows[i + 1].along);
    }
    for (RibbonRow& row : rows) row.toward = glm::cross(row.across, row.along);
    return ribbon;
}

void turn_to_principal_axis(std::span<const RibbonPoint> points, Ribbon& ribbon) {
    std::vector<Moments> moments(ribbon.rows.size());
    for (const RibbonPoint& at : points) {
        moments[nearest_row(at)].add({at.across, at.toward});
    }
    std::vector<glm::dvec2> axes(moments.size());
    glm::dvec2 mean(0.0);
    for (size_t i = 0; i < moments.size(); ++i) {
        axes[i] = moments[i].doubled_axis();
        mean += axes[i] / static_cast<double>(moments.size());
    }
    // A little of the mean everywhere, so that rows without a clear axis follow the others.
    for (glm::dvec2& axis : axes) axis += 0.1 * mean;
    smooth_all(axes, static_cast<int>(axes.size()));
    double last = 0.0;
    for (size_t i = 0; i < axes.size(); ++i) {
        double angle = glm::length(axes[i]) > 1e-15 ? 0.5 * std::atan2(axes[i].y, axes[i].x) : last;
        if (i > 0) angle -= std::numbers::pi * std::round((angle - last) / std::numbers::pi);
        turn(ribbon.rows[i], angle);
        last = angle;
    }
}

void move_to_middle(std::span<const RibbonPoint> points, Ribbon& ribbon) {
    const size_t count = ribbon.rows.size();
    constexpr float kFar = 1e30f;
    std::vector<glm::vec2> low(count, glm::vec2(kFar));
    std::vector<glm::vec2> high(count, glm::vec2(-kFar));
    for (const RibbonPoint& at : points) {
        for (const uint32_t row : {at.interval, at.interval + 1}) {
            low[row] = glm::min(low[row], glm::vec2(at.across, at.toward));
            high[row] = glm::max(high[row], glm::vec2(at.across, at.toward));
        }
    }
    std::vector<glm::vec2> middle(count, glm::vec2(0.0f));
    for (size_t i = 0; i < count; ++i) {
        if (low[i].x <= high[i].x) {
            middle[i] = 0.5f * (low[i] + high[i]);
        } else if (i > 0) {
            middle[i] = middle[i - 1];
        }
    }
    smooth_all(middle, 8);
    for (size_t i = 0; i < count; ++i) {
        RibbonRow& row = ribbon.rows[i];
        row.center += row.across * middle[i].x + row.toward * middle[i].y;
    }
    update_along(ribbon);
}

std::vector<uint32_t> rows_to_keep(const Ribbon& ribbon, float tolerance, uint32_t longest) {
    std::vector<uint32_t> kept{0};
    const auto last = static_cast<uint32_t>(ribbon.rows.size() - 1);
    keep_between(ribbon, 0, last, tolerance, longest, kept);
    kept.push_back(last);
    return kept;
}

}  // namespace vellus::hair::detail
