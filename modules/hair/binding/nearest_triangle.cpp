#include "modules/hair/binding/nearest_triangle.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <numeric>

namespace vellus::hair {

namespace {

constexpr uint32_t kLeaf = 4;
constexpr uint32_t kDeepest = 48;

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double longest =
        std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    // A height of 1e-5 of the longest edge: below it float cannot tell the normal.
    return glm::length(glm::cross(b - a, c - a)) > 1e-5 * longest && longest > 0.0;
}

double squared_distance(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 outside = glm::max(glm::max(low - p, p - high), glm::dvec3(0.0));
    return glm::dot(outside, outside);
}

}  // namespace

SurfacePoint nearest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                 const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const auto at = [&](double v, double w) {
        return SurfacePoint{0, {v, w}, glm::distance(p, a + ab * v + ac * w)};
    };
    const double d1 = glm::dot(ab, p - a);
    const double d2 = glm::dot(ac, p - a);
    if (d1 <= 0.0 && d2 <= 0.0) return at(0.0, 0.0);
    const double d3 = glm::dot(ab, p - b);
    const double d4 = glm::dot(ac, p - b);
    if (d3 >= 0.0 && d4 <= d3) return at(1.0, 0.0);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return at(d1 / (d1 - d3), 0.0);
    const double d5 = glm::dot(ab, p - c);
    const double d6 = glm::dot(ac, p - c);
    if (d6 >= 0.0 && d5 <= d6) return at(0.0, 1.0);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return at(0.0, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(1.0 - w, w);
    }
    const double sum = va + vb + vc;
    return at(vb / sum, vc / sum);
}

TriangleTree::TriangleTree(std::span<const glm::dvec3> positions,
                           std::span<const glm::uvec3> triangles)
    : positions_(positions), triangles_(triangles) {
    std::vector<glm::dvec3> centers(triangles.size());
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const glm::uvec3 v = triangles[t];
        if (!has_area(positions[v.x], positions[v.y], positions[v.z])) continue;
        centers[t] = (positions[v.x] + positions[v.y] + positions[v.z]) / 3.0;
        order_.push_back(t);
    }
    if (order_.empty()) return;
    nodes_.reserve(2 * order_.size());
    nodes_.push_back({});
    split(0, 0, static_cast<uint32_t>(order_.size()), 0, centers);
}

void TriangleTree::split(uint32_t node, uint32_t first, uint32_t last, uint32_t depth,
                         std::span<const glm::dvec3> centers) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    glm::dvec3 center_low = low;
    glm::dvec3 center_high = high;
    for (uint32_t i = first; i < last; ++i) {
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, positions_[triangles_[order_[i]][k]]);
            high = glm::max(high, positions_[triangles_[order_[i]][k]]);
        }
        center_low = glm::min(center_low, centers[order_[i]]);
        center_high = glm::max(center_high, centers[order_[i]]);
    }
    nodes_[node] = {low, high, first, last - first};
    if (last - first <= kLeaf || depth + 1 >= kDeepest) return;
    const glm::dvec3 size = center_high - center_low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](uint32_t a, uint32_t b) { return centers[a][axis] < centers[b][axis]; });
    const auto left = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({});
    nodes_.push_back({});
    nodes_[node].first = left;
    nodes_[node].count = 0;
    split(left, first, middle, depth + 1, centers);
    split(left + 1, middle, last, depth + 1, centers);
}

SurfacePoint TriangleTree::nearest(const glm::dvec3& p) const {
    assert(!empty());
    SurfacePoint best{0, {}, std::numeric_limits<double>::infinity()};
    std::array<uint32_t, kDeepest + 1> stack{};
    size_t size = 1;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (squared_distance(p, node.low, node.high) >= best.distance * best.distance) continue;
        if (node.count == 0) {
            const Node& left = nodes_[node.first];
            const Node& right = nodes_[node.first + 1];
            const bool left_first = squared_distance(p, left.low, left.high) <=
                                    squared_distance(p, right.low, right.high);
            stack[size++] = left_first ? node.first + 1 : node.first;
            stack[size++] = left_first ? node.first : node.first + 1;
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const glm::uvec3 v = triangles_[order_[i]];
            SurfacePoint point =
                nearest_on_triangle(p, positions_[v.x], positions_[v.y], positions_[v.z]);
            if (point.distance >= best.distance) continue;
            best = point;
            best.triangle = order_[i];
        }
    }
    return best;
}

}  // namespace vellus::hair
