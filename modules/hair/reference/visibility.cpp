#include "modules/hair/reference/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vellus::hair::reference {

namespace {

/// The part of a ray inside a convex body; empty until something is included.
struct Interval {
    double enter = std::numeric_limits<double>::infinity();
    double leave = -std::numeric_limits<double>::infinity();

    void include(double t) {
        enter = std::min(enter, t);
        leave = std::max(leave, t);
    }
};

/// Roots of a t² + 2 half t + c; none where they are equal.
bool solve(double a, double half, double c, double& low, double& high) {
    const double d = half * half - a * c;
    if (!(d > 0.0) || a == 0.0) return false;
    // The root without cancellation first, the other by their product.
    const double q = -(half + std::copysign(std::sqrt(d), half));
    low = q / a;
    high = c / q;
    if (low > high) std::swap(low, high);
    return true;
}

void include_ball(const glm::dvec3& center, double radius, const glm::dvec3& origin,
                  const glm::dvec3& direction, Interval& inside) {
    const glm::dvec3 o = origin - center;
    double low = 0.0;
    double high = 0.0;
    if (!solve(glm::dot(direction, direction), glm::dot(o, direction),
               glm::dot(o, o) - radius * radius, low, high)) {
        return;
    }
    inside.include(low);
    inside.include(high);
}

/// The cone that touches both balls: distance ρ from the axis and height y along it obey
/// ρ cos β + y sin β = radius_a, sin β = (radius_a - radius_b) / length.
void include_cone(const RoundSegment& s, const glm::dvec3& axis, double length, double sin_beta,
                  const glm::dvec3& origin, const glm::dvec3& direction, Interval& inside) {
    const double cos2 = 1.0 - sin_beta * sin_beta;
    const glm::dvec3 o = origin - s.a;
    const double y0 = glm::dot(o, axis);
    const double dy = glm::dot(direction, axis);
    const double r0 = s.radius_a - sin_beta * y0;
    const double dr = -sin_beta * dy;
    double roots[2];
    if (!solve(glm::dot(direction, direction) - dy * dy - dr * dr / cos2,
               glm::dot(o, direction) - y0 * dy - r0 * dr / cos2,
               glm::dot(o, o) - y0 * y0 - r0 * r0 / cos2, roots[0], roots[1])) {
        return;
    }
    for (const double t : roots) {
        const double y = y0 + t * dy;
        if (y >= s.radius_a * sin_beta && y <= length + s.radius_b * sin_beta) inside.include(t);
    }
}

}  // namespace

bool intersect(const RoundSegment& segment, const glm::dvec3& origin, const glm::dvec3& direction,
               double& enter, double& leave) {
    Interval inside;
    include_ball(segment.a, segment.radius_a, origin, direction, inside);
    include_ball(segment.b, segment.radius_b, origin, direction, inside);
    const glm::dvec3 along = segment.b - segment.a;
    const double length = glm::length(along);
    const double difference = segment.radius_a - segment.radius_b;
    // Where one ball holds the other there is no cone.
    if (length > std::abs(difference)) {
        include_cone(segment, along / length, length, difference / length, origin, direction,
                     inside);
    }
    enter = inside.enter;
    leave = inside.leave;
    return enter < leave;
}

std::vector<Crossing> crossings(std::span<const RoundSegment> segments, const glm::dvec3& origin,
                                const glm::dvec3& direction) {
    std::vector<Crossing> found;
    for (const RoundSegment& segment : segments) {
        Crossing crossing{.opacity = segment.opacity, .strand = segment.strand};
        if (!intersect(segment, origin, direction, crossing.enter, crossing.leave)) continue;
        if (crossing.leave > 0.0) found.push_back(crossing);
    }
    std::ranges::sort(found, [](const Crossing& x, const Crossing& y) {
        return x.strand != y.strand ? x.strand < y.strand : x.enter < y.enter;
    });
    std::vector<Crossing> merged;
    for (const Crossing& next : found) {
        if (!merged.empty() && merged.back().strand == next.strand &&
            next.enter <= merged.back().leave) {
            merged.back().leave = std::max(merged.back().leave, next.leave);
            merged.back().opacity = std::max(merged.back().opacity, next.opacity);
        } else {
            merged.push_back(next);
        }
    }
    std::erase_if(merged, [](const Crossing& c) { return c.enter < 0.0; });
    std::ranges::stable_sort(merged, {}, &Crossing::enter);
    return merged;
}

Transmittance::Transmittance(std::span<const Crossing> sorted) {
    double left = 1.0;
    for (const Crossing& crossing : sorted) {
        left *= 1.0 - crossing.opacity;
        depths_.push_back(crossing.enter);
        values_.push_back(left);
    }
}

double Transmittance::at(double depth) const {
    // Strands that begin strictly before `depth` stand in the way.
    const auto behind = std::ranges::lower_bound(depths_, depth);
    return behind == depths_.begin() ? 1.0 : values_[behind - depths_.begin() - 1];
}

Transmittance transmittance_along(std::span<const RoundSegment> segments, const glm::dvec3& origin,
                                  const glm::dvec3& direction) {
    return Transmittance(crossings(segments, origin, direction));
}

}  // namespace vellus::hair::reference
