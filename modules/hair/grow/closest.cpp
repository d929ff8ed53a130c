#include "modules/hair/grow/closest.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <unordered_map>

#include "modules/hair/grow/chance.h"

namespace vellus::hair::grow {

namespace {

constexpr size_t kLeafTriangles = 4;
constexpr int kDeepest = 64;
/// Pushing along a smooth normal falls a little short on curved skin, so it is repeated.
constexpr int kPushes = 3;

struct BitHash {
    size_t operator()(glm::vec3 p) const {
        std::array<uint32_t, 3> bits{};
        std::memcpy(bits.data(), &p, sizeof(bits));
        return (size_t{bits[0]} * 73856093U) ^ (size_t{bits[1]} * 19349663U) ^
               (size_t{bits[2]} * 83492791U);
    }
};

/// Normals averaged over vertices in one place, so that the surface has no seams.
std::vector<glm::vec3> smooth_normals(const GrowSurface& surface) {
    std::unordered_map<glm::vec3, glm::dvec3, BitHash> sums;
    for (size_t v = 0; v < surface.positions.size(); ++v) {
        sums[surface.positions[v] + 0.0f] += glm::dvec3(surface.normals[v]);
    }
    std::vector<glm::vec3> normals(surface.positions.size());
    for (size_t v = 0; v < normals.size(); ++v) {
        normals[v] =
            glm::vec3(unit(sums[surface.positions[v] + 0.0f], glm::dvec3(surface.normals[v])));
    }
    return normals;
}

double squared_distance(glm::dvec3 p, glm::vec3 low, glm::vec3 high) {
    const glm::dvec3 outside = glm::max(glm::max(glm::dvec3(low) - p, p - glm::dvec3(high)), 0.0);
    return glm::dot(outside, outside);
}

}  // namespace

struct ClosestPoint::Nearest {
    double squared = 0.0;
    uint32_t triangle = 0;
    glm::dvec2 at{0.0};
    bool found = false;
};

ClosestPoint::ClosestPoint(const GrowSurface& surface) : normals_(smooth_normals(surface)) {
    const size_t count = surface.triangle_count();
    std::vector<glm::vec3> centers(count);
    for (size_t t = 0; t < count; ++t) {
        for (size_t i = 0; i < 3; ++i) {
            centers[t] += surface.positions[surface.triangles[3 * t + i]] / 3.0f;
        }
    }
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    triangles_.reserve(count);
    nodes_.reserve(count);
    if (count > 0) build(order, centers, surface);
}

void ClosestPoint::build(std::span<uint32_t> order, const std::vector<glm::vec3>& centers,
                         const GrowSurface& surface) {
    Bounds box;
    Bounds middle;
    for (const uint32_t t : order) {
        middle.add(centers[t]);
        for (size_t i = 0; i < 3; ++i) box.add(surface.positions[surface.triangles[3 * t + i]]);
    }
    const size_t node = nodes_.size();
    nodes_.push_back({box.low, box.high});
    if (order.size() <= kLeafTriangles) {
        nodes_[node].next = static_cast<uint32_t>(triangles_.size());
        nodes_[node].count = static_cast<uint32_t>(order.size());
        for (const uint32_t t : order) {
            const uint32_t* v = &surface.triangles[size_t{3} * t];
            const glm::dvec3 a(surface.positions[v[0]]);
            triangles_.push_back({a,
                                  glm::dvec3(surface.positions[v[1]]) - a,
                                  glm::dvec3(surface.positions[v[2]]) - a,
                                  {v[0], v[1], v[2]}});
        }
        return;
    }
    const glm::vec3 size = middle.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto half = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), half, order.end(), [&](uint32_t a, uint32_t b) {
        return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b);
    });
    build(order.first(order.size() / 2), centers, surface);
    nodes_[node].next = static_cast<uint32_t>(nodes_.size());
    build(order.subspan(order.size() / 2), centers, surface);
}

// Ericson, Real-Time Collision Detection, 5.1.5: the Voronoi region of the triangle p lies in.
void ClosestPoint::visit(const Triangle& triangle, uint32_t index, glm::dvec3 p, Nearest& nearest) {
    const glm::dvec3 ap = p - triangle.a;
    const double d1 = glm::dot(triangle.ab, ap);
    const double d2 = glm::dot(triangle.ac, ap);
    const double bb = glm::dot(triangle.ab, triangle.ab);
    const double bc = glm::dot(triangle.ab, triangle.ac);
    const double cc = glm::dot(triangle.ac, triangle.ac);
    const double d3 = d1 - bb;
    const double d4 = d2 - bc;
    const double d5 = d1 - bc;
    const double d6 = d2 - cc;
    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    glm::dvec2 at(0.0);
    if (d1 <= 0.0 && d2 <= 0.0) {
        at = {0.0, 0.0};
    } else if (d3 >= 0.0 && d4 <= d3) {
        at = {1.0, 0.0};
    } else if (d6 >= 0.0 && d5 <= d6) {
        at = {0.0, 1.0};
    } else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        at = {d1 / (d1 - d3), 0.0};
    } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        at = {0.0, d2 / (d2 - d6)};
    } else if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        at = {1.0 - t, t};
    } else {
        at = glm::dvec2(vb, vc) / (va + vb + vc);
    }
    const glm::dvec3 offset = triangle.ab * at.x + triangle.ac * at.y - ap;
    const double squared = glm::dot(offset, offset);
    // A NaN of a triangle without area is not smaller.
    if (!(squared < nearest.squared)) return;
    nearest = {squared, index, at, true};
}

Closest ClosestPoint::operator()(glm::dvec3 p, double reach) const {
    Nearest nearest{.squared = reach * reach};
    std::array<std::pair<double, uint32_t>, kDeepest> stack;
    size_t depth = 0;
    if (!nodes_.empty()) {
        stack[depth++] = {squared_distance(p, nodes_[0].low, nodes_[0].high), 0};
    }
    while (depth > 0) {
        const auto [squared, index] = stack[--depth];
        if (squared >= nearest.squared) continue;
        const Node& node = nodes_[index];
        if (node.count > 0) {
            for (uint32_t t = node.next; t < node.next + node.count; ++t) {
                visit(triangles_[t], t, p, nearest);
            }
            continue;
        }
        const Node& first = nodes_[index + 1];
        const Node& second = nodes_[node.next];
        std::pair near(squared_distance(p, first.low, first.high), index + 1);
        std::pair far(squared_distance(p, second.low, second.high), node.next);
        if (far.first < near.first) std::swap(near, far);
        if (far.first < nearest.squared) stack[depth++] = far;
        if (near.first < nearest.squared) stack[depth++] = near;
    }
    if (!nearest.found) return {};
    const Triangle& triangle = triangles_[nearest.triangle];
    Closest closest;
    closest.found = true;
    closest.point = triangle.a + triangle.ab * nearest.at.x + triangle.ac * nearest.at.y;
    closest.normal =
        unit(glm::dvec3(normals_[triangle.vertex[0]]) * (1.0 - nearest.at.x - nearest.at.y) +
                 glm::dvec3(normals_[triangle.vertex[1]]) * nearest.at.x +
                 glm::dvec3(normals_[triangle.vertex[2]]) * nearest.at.y,
             glm::dvec3(normals_[triangle.vertex[0]]));
    const bool inside = glm::dot(p - closest.point, closest.normal) < 0.0;
    closest.distance = std::sqrt(nearest.squared) * (inside ? -1.0 : 1.0);
    return closest;
}

glm::dvec3 ClosestPoint::push_out(glm::dvec3 p, double clearance, double reach) const {
    for (int push = 0; push < kPushes; ++push) {
        const Closest closest = (*this)(p, std::max(reach, clearance));
        if (!closest.found || closest.distance >= clearance * 0.999) break;
        p = closest.distance < 0.0 ? closest.point + closest.normal * clearance
                                   : p + closest.normal * (clearance - closest.distance);
    }
    return p;
}

}  // namespace vellus::hair::grow
