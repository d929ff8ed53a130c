#include "modules/hair/cards/ribbon.h"

#include <algorithm>
#include <cmath>

#include "modules/hair/cards/ribbon_detail.h"
#include "modules/hair/cards/strand_path.h"

namespace vellus::hair {

namespace {

/// Samples of each strand that measure its spread.
constexpr uint32_t kSamples = 96;
/// Rows before simplification.
constexpr uint32_t kDense = 64;
/// Intervals are at most this share of the ribbon, so that its width can taper.
constexpr uint32_t kLongestInterval = kDense / 8;
/// Radians of turns too tight for the cluster from which on its strands wind: a whole turn.
constexpr float kWinding = 6.2831853f;
/// Straightening measures the strands anew after so many passes, so many times at most.
constexpr int kStraightenPasses = 8;
constexpr int kStraightenRounds = 32;
/// Half axes are at least this long, in metres, so that every ribbon has an area.
constexpr float kLeastHalfAxis = 2e-5f;
/// Of a single strand's width: how far its centreline may lie beside it.
constexpr float kThinTolerance = 0.1f;
/// A cross-section through a point is the wrong one if its middle is so many times as far away as
/// the point at the same share of the ribbon.
constexpr float kFarther = 1.1f;

float mix_rows(const Ribbon& ribbon, const RibbonPoint& at, float RibbonRow::*value) {
    return glm::mix(ribbon.rows[at.interval].*value, ribbon.rows[at.interval + 1].*value, at.t);
}

float signed_distance(const RibbonRow& row, glm::vec3 p) {
    return glm::dot(p - row.center, row.along);
}

std::vector<glm::vec3> mean_centerline(const StrandData& strands,
                                       std::span<const uint32_t> members) {
    std::vector<glm::vec3> line(kDense);
    for (uint32_t i = 0; i < kDense; ++i) {
        const float fraction = static_cast<float>(i) / (kDense - 1);
        glm::dvec3 sum(0.0);
        for (const uint32_t strand : members) {
            sum += glm::dvec3(strand_position(strands, strand, fraction));
        }
        line[i] = glm::vec3(sum / static_cast<double>(members.size()));
    }
    return line;
}

/// How far strands lie from the line, across it, at each of its points: twice the root mean square.
std::vector<float> measure_radius(const StrandData& strands, std::span<const uint32_t> members,
                                  const std::vector<glm::vec3>& line) {
    std::vector<float> radius(kDense);
    for (uint32_t i = 0; i < kDense; ++i) {
        const float fraction = static_cast<float>(i) / (kDense - 1);
        const glm::vec3 chord = line[std::min(i + 1, kDense - 1)] - line[i > 0 ? i - 1 : 0];
        const float squared = std::max(glm::dot(chord, chord), 1e-20f);
        double sum = 0.0;
        for (const uint32_t strand : members) {
            glm::vec3 offset = strand_position(strands, strand, fraction) - line[i];
            offset -= chord * (glm::dot(offset, chord) / squared);
            sum += glm::dot(offset, offset);
        }
        radius[i] = 2.0f * std::sqrt(static_cast<float>(sum / static_cast<double>(members.size())));
    }
    return radius;
}

/// Whether the strands wind about a common axis, so that their mean does too and its cross-sections
/// meet within them.
bool winds(const StrandData& strands, std::span<const uint32_t> members,
           const std::vector<glm::vec3>& line) {
    return detail::crowded_turn(line, measure_radius(strands, members, line)) > kWinding;
}

/// Turns the mean of strands that wind into their axis, the only line that can carry them.
void straighten(const StrandData& strands, std::span<const uint32_t> members,
                std::vector<glm::vec3>& line) {
    for (int round = 0; round < kStraightenRounds; ++round) {
        const std::vector<float> radius = measure_radius(strands, members, line);
        if (!detail::straighten(line, radius, kStraightenPasses)) return;
    }
}

/// Rows moved to the middle of what they hold follow the turns again, a little.
void straighten(const StrandData& strands, std::span<const uint32_t> members, Ribbon& ribbon) {
    std::vector<glm::vec3> line;
    for (const RibbonRow& row : ribbon.rows) line.push_back(row.center);
    straighten(strands, members, line);
    for (size_t i = 0; i < line.size(); ++i) ribbon.rows[i].center = line[i];
    detail::update_along(ribbon);
}

/// Moves the ends outwards so that the cross-sections there lie beyond all roots and tips.
void reach_ends(const StrandData& strands, std::span<const uint32_t> members,
                std::vector<glm::vec3>& line) {
    const auto direction = [](glm::vec3 from, glm::vec3 to) {
        const glm::vec3 d = to - from;
        const float length = glm::length(d);
        return length > 0.0f ? d / length : glm::vec3(0, 1, 0);
    };
    const glm::vec3 root = direction(line[1], line[0]);
    const glm::vec3 tip = direction(line[kDense - 2], line[kDense - 1]);
    float root_reach = 0.0f;
    float tip_reach = 0.0f;
    for (const uint32_t strand : members) {
        const glm::vec3 first = strands.positions[strands.strand_begin[strand]];
        const glm::vec3 last = strands.positions[strands.strand_begin[strand + 1] - 1];
        root_reach = std::max(root_reach, glm::dot(first - line.front(), root));
        tip_reach = std::max(tip_reach, glm::dot(last - line.back(), tip));
    }
    line.front() += root * root_reach;
    line.back() += tip * tip_reach;
}

/// Where the strands lie as the ribbon sees them, each with half its width there.
struct Spread {
    std::vector<RibbonPoint> points;
    std::vector<float> radius;
};

Spread measure_spread(const StrandData& strands, std::span<const uint32_t> members,
                      const Ribbon& ribbon, float tip_scale) {
    Spread spread;
    spread.points.reserve(members.size() * kSamples);
    spread.radius.reserve(members.size() * kSamples);
    for (const uint32_t strand : members) {
        uint32_t hint = 0;
        const size_t root = strands.strand_begin[strand];
        const float width = strand_width(strands, root, 1.0f);
        for (uint32_t i = 0; i < kSamples; ++i) {
            const float fraction = static_cast<float>(i) / (kSamples - 1);
            const RibbonPoint at =
                ribbon.locate(strand_position(strands, strand, fraction), fraction, hint);
            hint = at.interval;
            spread.points.push_back(at);
            spread.radius.push_back(0.5f * width * glm::mix(1.0f, tip_scale, fraction));
        }
    }
    return spread;
}

/// Half axes of every row: those of the strands in the intervals beside it, so that what lies
/// between two rows lies within both.
void reach_strands(const Spread& spread, Ribbon& ribbon) {
    for (RibbonRow& row : ribbon.rows) row.half_width = row.half_thickness = kLeastHalfAxis;
    for (size_t i = 0; i < spread.points.size(); ++i) {
        const RibbonPoint& at = spread.points[i];
        for (const uint32_t row : {at.interval, at.interval + 1}) {
            RibbonRow& r = ribbon.rows[row];
            r.half_width = std::max(r.half_width, std::abs(at.across) + spread.radius[i]);
            r.half_thickness = std::max(r.half_thickness, std::abs(at.toward) + spread.radius[i]);
        }
    }
}

Ribbon pick_rows(const Ribbon& dense, const std::vector<uint32_t>& kept) {
    Ribbon ribbon;
    for (const uint32_t row : kept) ribbon.rows.push_back(dense.rows[row]);
    detail::update_along(ribbon);
    for (RibbonRow& row : ribbon.rows) {
        const glm::vec3 across = row.across - row.along * glm::dot(row.across, row.along);
        const float length = glm::length(across);
        row.across = length > 1e-6f ? across / length : detail::any_perpendicular(row.along);
        row.toward = glm::cross(row.across, row.along);
    }
    return ribbon;
}

}  // namespace

RibbonPoint Ribbon::locate(glm::vec3 p, float fraction, uint32_t hint) const {
    const auto away = [&](const RibbonPoint& at) {
        return glm::distance(
            p, glm::mix(rows[at.interval].center, rows[at.interval + 1].center, at.t));
    };
    const RibbonPoint through = cross_section_through(p, hint);
    RibbonPoint same = at_fraction(fraction);
    if (away(through) <= kFarther * away(same)) return through;
    measure(p, same);
    return same;
}

RibbonPoint Ribbon::at_fraction(float fraction) const {
    const float distance = fraction * length();
    const auto after = std::ranges::upper_bound(rows.begin() + 1, rows.end() - 1, distance, {},
                                                &RibbonRow::distance);
    RibbonPoint at{.interval = static_cast<uint32_t>(after - rows.begin() - 1)};
    const float span = after->distance - rows[at.interval].distance;
    at.t =
        span > 0.0f ? std::clamp((distance - rows[at.interval].distance) / span, 0.0f, 1.0f) : 0.0f;
    return at;
}

void Ribbon::measure(glm::vec3 p, RibbonPoint& at) const {
    const RibbonRow& a = rows[at.interval];
    const RibbonRow& b = rows[at.interval + 1];
    const glm::vec3 offset = p - glm::mix(a.center, b.center, at.t);
    at.across = glm::dot(offset, glm::normalize(glm::mix(a.across, b.across, at.t)));
    at.toward = glm::dot(offset, glm::normalize(glm::mix(a.toward, b.toward, at.t)));
}

RibbonPoint Ribbon::cross_section_through(glm::vec3 p, uint32_t hint) const {
    const auto last = static_cast<uint32_t>(rows.size() - 2);
    uint32_t i = std::min(hint, last);
    float before = signed_distance(rows[i], p);
    while (before < 0.0f && i > 0) before = signed_distance(rows[--i], p);
    float after = signed_distance(rows[i + 1], p);
    while (after > 0.0f && i < last) {
        before = after;
        after = signed_distance(rows[++i + 1], p);
    }
    RibbonPoint at{.interval = i};
    const float span = before - after;
    at.t = span > 0.0f ? std::clamp(before / span, 0.0f, 1.0f) : 0.0f;
    measure(p, at);
    return at;
}

float Ribbon::distance(const RibbonPoint& at) const {
    return mix_rows(*this, at, &RibbonRow::distance);
}

float Ribbon::half_width(const RibbonPoint& at) const {
    return mix_rows(*this, at, &RibbonRow::half_width);
}

float Ribbon::half_thickness(const RibbonPoint& at) const {
    return mix_rows(*this, at, &RibbonRow::half_thickness);
}

Ribbon fit_ribbon(const StrandData& strands, std::span<const uint32_t> members,
                  const RibbonLimits& limits) {
    std::vector<glm::vec3> line = mean_centerline(strands, members);
    detail::smooth(line, 2);
    const bool winding = winds(strands, members, line);
    if (winding) straighten(strands, members, line);
    reach_ends(strands, members, line);
    Ribbon dense = detail::transport_frames(line);
    Spread spread = measure_spread(strands, members, dense, limits.tip_scale);
    detail::turn_to_principal_axis(spread.points, dense);
    spread = measure_spread(strands, members, dense, limits.tip_scale);
    detail::move_to_middle(spread.points, dense);
    if (winding) straighten(strands, members, dense);

    // Around a single strand the ribbon is as thin as that.
    const float least =
        kThinTolerance * strand_width(strands, strands.strand_begin[members[0]], 1.0f);
    float tolerance = members.size() > 1 ? limits.tolerance : std::min(limits.tolerance, least);
    std::vector<uint32_t> kept = detail::rows_to_keep(dense, tolerance, kLongestInterval);
    // Too many rows: coarser bends first, and longer intervals where those alone are too many.
    uint32_t longest = kLongestInterval;
    while (kept.size() > limits.max_rows) {
        tolerance *= 1.3f;
        while (longest < kDense && (kDense - 1) / longest + 2 > limits.max_rows) longest *= 2;
        kept = detail::rows_to_keep(dense, tolerance, longest);
    }
    Ribbon ribbon = pick_rows(dense, kept);
    spread = measure_spread(strands, members, ribbon, limits.tip_scale);
    reach_strands(spread, ribbon);
    return ribbon;
}

}  // namespace vellus::hair
