#include "modules/hair/binding/bind_roots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/platform/jobs.h"
#include "modules/hair/binding/nearest_triangle.h"
#include "modules/hair/binding/root_frame.h"
#include "modules/hair/groom/morton.h"

namespace vellus::hair {

namespace {

constexpr size_t kGrain = 64;
constexpr size_t kMostClusters = 512;
constexpr uint32_t kUnused = ~0U;
/// Below this cosine between smooth and flat normal the smooth one lies too much in the triangle.
constexpr double kFlatCosine = 0.3;

struct RestFrame {
    glm::dvec3 position;
    glm::dmat3 axes;  ///< unit
};

/// Puts the root where it is nearest, and returns its frame at rest.
RestFrame place_root(const RestMesh& mesh, const TriangleTree& tree, const glm::dvec3& p,
                     BoundRoot& root, double& distance) {
    const SurfacePoint at = tree.nearest(p);
    distance = at.distance;
    root.vertices = mesh.triangles[at.triangle];
    root.barycentric = glm::vec2(at.barycentric);
    const glm::dvec2 bary(root.barycentric);
    const glm::uvec3 v = root.vertices;
    const glm::dvec3 e1 = mesh.positions[v.y] - mesh.positions[v.x];
    const glm::dvec3 e2 = mesh.positions[v.z] - mesh.positions[v.x];
    const glm::dvec3 flat = glm::normalize(glm::cross(e1, e2));
    glm::dvec3 normal = mesh.normals[v.x] * (1.0 - bary.x - bary.y) + mesh.normals[v.y] * bary.x +
                        mesh.normals[v.z] * bary.y;
    const double length = glm::length(normal);
    root.flat = length > 0.0 && std::abs(glm::dot(normal, flat)) > kFlatCosine * length ? 0 : 1;
    const glm::vec3 n(root.flat != 0 ? flat : normal / length);
    // The same basis as root_axes takes, so that at rest its turn is none.
    const glm::vec3 x = glsl::any_across(n);
    const glm::dvec3 y(glm::cross(n, x));
    const glm::dmat2 edges({glm::dot(e1, glm::dvec3(x)), glm::dot(e1, y)},
                           {glm::dot(e2, glm::dvec3(x)), glm::dot(e2, y)});
    const glm::dmat2 inverse = glm::inverse(edges);
    root.rest_inverse = {inverse[0][0], inverse[0][1], inverse[1][0], inverse[1][1]};
    return {mesh.positions[v.x] + e1 * bary.x + e2 * bary.y,
            glm::dmat3(glm::dvec3(x), glm::dvec3(n), glm::dvec3(glm::cross(x, n)))};
}

/// Keeps the vertices some root stands on, in their order.
void compact_vertices(const RestMesh& mesh, BoundRoots& bound) {
    std::vector<uint32_t> place(mesh.vertices.size(), kUnused);
    for (const BoundRoot& root : bound.roots) {
        for (int k = 0; k < 3; ++k) place[root.vertices[k]] = 0;
    }
    std::vector<uint32_t> kept;
    for (uint32_t v = 0; v < place.size(); ++v) {
        if (place[v] == kUnused) continue;
        place[v] = static_cast<uint32_t>(kept.size());
        kept.push_back(v);
        bound.vertices.push_back(mesh.vertices[v]);
    }
    for (uint32_t t = 0; t < mesh.target_count; ++t) {
        for (const uint32_t v : kept) {
            bound.morphs.push_back(mesh.morphs[t * mesh.vertices.size() + v]);
        }
    }
    for (BoundRoot& root : bound.roots) {
        for (int k = 0; k < 3; ++k) root.vertices[k] = place[root.vertices[k]];
    }
}

/// Strands along a Morton curve through their roots. In memory they come in levels of detail, of
/// which each is spread over the whole groom.
std::vector<uint32_t> neighbours_in_order(std::span<const RestFrame> frames) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (const RestFrame& frame : frames) {
        low = glm::min(low, frame.position);
        high = glm::max(high, frame.position);
    }
    const glm::dvec3 size = glm::max(high - low, 1e-30);
    std::vector<std::pair<uint32_t, uint32_t>> keys(frames.size());
    for (uint32_t s = 0; s < frames.size(); ++s) {
        keys[s] = {morton_code((frames[s].position - low) / size), s};
    }
    std::ranges::sort(keys);
    std::vector<uint32_t> order(keys.size());
    std::ranges::transform(keys, order.begin(), [](const auto& key) { return key.second; });
    return order;
}

/// Where runs of `order` begin whose roots lie within `radius` of the run's first; one past the
/// last one.
std::vector<uint32_t> runs_within(std::span<const RestFrame> frames,
                                  std::span<const uint32_t> order, double radius) {
    std::vector<uint32_t> begin = {0};
    for (uint32_t i = 1; i < order.size(); ++i) {
        const RestFrame& first = frames[order[begin.back()]];
        if (glm::distance(frames[order[i]].position, first.position) > radius) begin.push_back(i);
    }
    begin.push_back(static_cast<uint32_t>(order.size()));
    return begin;
}

/// The box of a run in the frame of its middle strand. Where a run bends its strands turn a little
/// against each other: the box gets a tenth of their length and a quarter of the run's radius.
BoundCluster cluster_of(std::span<const RestFrame> frames, const BoundRoots& bound,
                        std::span<const uint32_t> run) {
    const double scale = std::abs(bound.rest_scale);
    const uint32_t middle = run[run.size() / 2];
    const glm::dmat3 to_middle = glm::transpose(frames[middle].axes) / scale;
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    double reach = 0.0;
    double spread = 0.0;
    for (const uint32_t s : run) {
        const BoundRoot& root = bound.roots[s];
        const glm::dvec3 from_middle = frames[s].position - frames[middle].position;
        spread = std::max(spread, glm::length(from_middle) / scale);
        for (uint32_t i = root.first_point; i < root.first_point + root.point_count; ++i) {
            const glm::dvec3 local(bound.local[i]);
            const glm::dvec3 here = to_middle * (from_middle + frames[s].axes * local * scale);
            low = glm::min(low, here);
            high = glm::max(high, here);
            reach = std::max(reach, glm::length(local));
        }
    }
    const double pad = run.size() > 1 ? 0.1 * reach + 0.25 * spread : 1e-5 * reach;
    return {middle, glm::vec3(low - pad), glm::vec3(high + pad)};
}

/// Runs along the curve are patches; where it jumps a new one starts. As small patches as the
/// number of clusters allows.
void cluster_strands(std::span<const RestFrame> frames, BoundRoots& bound) {
    double radius = 0.5 * bound.reach * std::abs(bound.rest_scale);
    const auto order = neighbours_in_order(frames);
    auto begin = runs_within(frames, order, radius);
    while (begin.size() > kMostClusters + 1) {
        radius *= 1.25;
        begin = runs_within(frames, order, radius);
    }
    for (size_t c = 0; c + 1 < begin.size(); ++c) {
        bound.clusters.push_back(
            cluster_of(frames, bound, std::span(order).subspan(begin[c], begin[c + 1] - begin[c])));
    }
}

}  // namespace

Result<BoundRoots> bind_roots(const StrandShape& strands, const glm::dmat4& placement,
                              const RestMesh& mesh) {
    BoundRoots bound;
    bound.target_count = mesh.target_count;
    bound.joint_count = mesh.joint_count;
    bound.placement = placement;
    bound.rest_scale = std::cbrt(glm::determinant(glm::dmat3(placement)));
    const size_t count = strands.strand_begin.empty() ? 0 : strands.strand_begin.size() - 1;
    if (count == 0) return bound;
    const TriangleTree tree(mesh.positions, mesh.triangles);
    if (tree.empty()) {
        return Error{"no triangle has an area", "mesh", "bind hair to a mesh with a surface"};
    }
    bound.roots.resize(count);
    bound.local.resize(strands.positions.size());
    std::vector<RestFrame> frames(count);
    std::vector<double> distances(count);
    parallel_ranges(count, kGrain, [&](size_t first, size_t last) {
        for (size_t s = first; s < last; ++s) {
            BoundRoot& root = bound.roots[s];
            root.first_point = strands.strand_begin[s];
            root.point_count = strands.strand_begin[s + 1] - root.first_point;
            const auto placed = [&](uint32_t i) {
                return glm::dvec3(placement * glm::dvec4(strands.positions[i], 1.0));
            };
            frames[s] = place_root(mesh, tree, placed(root.first_point), root, distances[s]);
            const glm::dmat3 to_local = glm::transpose(frames[s].axes) / std::abs(bound.rest_scale);
            for (uint32_t i = root.first_point; i < root.first_point + root.point_count; ++i) {
                bound.local[i] = glm::vec3(to_local * (placed(i) - frames[s].position));
            }
        }
    });
    for (const glm::vec3& p : bound.local) bound.reach = std::max(bound.reach, glm::length(p));
    bound.farthest = *std::ranges::max_element(distances);
    cluster_strands(frames, bound);
    compact_vertices(mesh, bound);
    return bound;
}

}  // namespace vellus::hair
