#include "modules/hair/grow/roots.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>

#include "modules/hair/grow/chance.h"

// Candidates are drawn by systematic sampling along the triangles, so their number in any stretch
// of skin is right within one. Roots are then taken from them in random order, as long as they
// keep a distance to those taken before; the distance shrinks level by level (hierarchical
// Poisson-disk sampling, McCool and Fiume 1992), which makes every beginning of the list even.
namespace vellus::hair::grow {

namespace {

/// Candidates for each root: more of them leave fewer close pairs.
constexpr uint32_t kCandidates = 3;
/// Darts thrown at a triangle for one candidate, where little of it is haired.
constexpr uint32_t kAttempts = 64;
/// The distance of a level over that of the next: twice the roots fit.
constexpr double kLevelRatio = 0.70710678118654752;
/// Share of the densest packing's distance that random darts reach easily.
constexpr double kPacking = 0.70;

struct Candidate {
    glm::dvec3 position;
    uint32_t triangle;
    float u, v;
    float density;
};

/// A point of the triangle whose likelihood follows density and mask; nothing where none is found.
std::optional<Candidate> pick(const GrowSurface& surface, size_t triangle, uint32_t seed,
                              uint32_t key) {
    const uint32_t* corner = &surface.triangles[3 * triangle];
    const double most = std::max(
        {surface.density[corner[0]], surface.density[corner[1]], surface.density[corner[2]]});
    for (uint32_t attempt = 0; attempt < kAttempts; ++attempt) {
        double u = random(seed, key, 3 * attempt + 101);
        double v = random(seed, key, 3 * attempt + 102);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const double density = density_at(surface, triangle, u, v);
        if (random(seed, key, 3 * attempt + 103) * most >= density) continue;
        const glm::dvec3 a(surface.positions[corner[0]]);
        const glm::dvec3 ab = glm::dvec3(surface.positions[corner[1]]) - a;
        const glm::dvec3 ac = glm::dvec3(surface.positions[corner[2]]) - a;
        return Candidate{a + ab * u + ac * v, static_cast<uint32_t>(triangle),
                         static_cast<float>(u), static_cast<float>(v), static_cast<float>(density)};
    }
    return std::nullopt;
}

std::vector<Candidate> draw_candidates(const GrowSurface& surface, uint64_t count, double total,
                                       uint32_t seed) {
    std::vector<Candidate> candidates;
    candidates.reserve(count);
    const double step = total / static_cast<double>(count);
    double next = step * random(seed, 0, 100);
    double end = 0.0;
    uint32_t key = 0;
    for (size_t triangle = 0; triangle < surface.triangle_count(); ++triangle) {
        end += haired_area(surface, triangle);
        for (; next < end && key < count; next += step) {
            if (auto found = pick(surface, triangle, seed, ++key)) candidates.push_back(*found);
        }
    }
    return candidates;
}

/// Roots taken so far, by the cell of a grid they lie in.
class Taken {
  public:
    Taken(double cell, size_t capacity) : cell_(cell) {
        size_t buckets = 16;
        while (buckets < 2 * capacity) buckets *= 2;
        heads_.assign(buckets, kNone);
    }

    [[nodiscard]] bool any_within(const std::vector<Candidate>& candidates, glm::dvec3 p,
                                  double distance) const {
        const glm::ivec3 first = cell_of(p - distance);
        const glm::ivec3 last = cell_of(p + distance);
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x) {
                    if (in_cell(candidates, p, distance, bucket({x, y, z}))) return true;
                }
            }
        }
        return false;
    }
    void add(const std::vector<Candidate>& candidates, uint32_t index) {
        const size_t at = bucket(cell_of(candidates[index].position));
        entries_.push_back({index, heads_[at]});
        heads_[at] = static_cast<uint32_t>(entries_.size() - 1);
    }

  private:
    static constexpr uint32_t kNone = ~0U;
    struct Entry {
        uint32_t candidate;
        uint32_t next;
    };

    [[nodiscard]] glm::ivec3 cell_of(glm::dvec3 p) const {
        return glm::ivec3(glm::floor(p / cell_));
    }
    [[nodiscard]] size_t bucket(glm::ivec3 c) const {
        const auto x = static_cast<uint32_t>(c.x);
        const auto y = static_cast<uint32_t>(c.y);
        const auto z = static_cast<uint32_t>(c.z);
        uint32_t h = x * 73856093U ^ y * 19349663U ^ z * 83492791U;
        h ^= h >> 15U;
        return h & (heads_.size() - 1);
    }
    [[nodiscard]] bool in_cell(const std::vector<Candidate>& candidates, glm::dvec3 p,
                               double distance, size_t at) const {
        for (uint32_t e = heads_[at]; e != kNone; e = entries_[e].next) {
            const glm::dvec3 d = candidates[entries_[e].candidate].position - p;
            if (glm::dot(d, d) < distance * distance) return true;
        }
        return false;
    }

    double cell_;
    std::vector<uint32_t> heads_;
    std::vector<Entry> entries_;
};

/// Takes what keeps `distance` (at full density; further apart where it is thin); the rest stays in
/// `waiting`, in its order.
void take_level(const std::vector<Candidate>& candidates, double distance, size_t count,
                std::vector<uint32_t>& waiting, std::vector<uint32_t>& order) {
    Taken taken(distance, order.size() * 2 + 1024);
    for (const uint32_t index : order) taken.add(candidates, index);
    size_t kept = 0;
    for (const uint32_t index : waiting) {
        const Candidate& candidate = candidates[index];
        const double apart = distance / std::sqrt(std::max(double{candidate.density}, 0.04));
        if (order.size() >= count || taken.any_within(candidates, candidate.position, apart)) {
            waiting[kept++] = index;
            continue;
        }
        taken.add(candidates, index);
        order.push_back(index);
    }
    waiting.resize(kept);
}

std::vector<uint32_t> progressive_order(const std::vector<Candidate>& candidates, size_t count,
                                        double area, uint32_t seed) {
    std::vector<uint32_t> waiting(candidates.size());
    std::iota(waiting.begin(), waiting.end(), 0U);
    std::ranges::sort(waiting, {}, [&](uint32_t i) { return std::pair(hash(seed, i, 7), i); });
    std::vector<uint32_t> order;
    order.reserve(count);
    // Distance of the densest packing: each point owns a hexagon of sqrt(3)/2 d^2.
    const double finest =
        kPacking * std::sqrt(area / static_cast<double>(count) / 0.86602540378443865);
    double distance = finest;
    for (size_t n = count; n > 4; n /= 2) distance /= kLevelRatio;
    for (; order.size() < count && distance > finest * 0.05; distance *= kLevelRatio) {
        take_level(candidates, std::max(distance, 1e-12), count, waiting, order);
    }
    for (size_t i = 0; order.size() < count && i < waiting.size(); ++i) order.push_back(waiting[i]);
    return order;
}

Root make_root(const GrowSurface& surface, const Candidate& candidate) {
    const uint32_t* v = &surface.triangles[size_t{3} * candidate.triangle];
    const float w[3] = {1.0f - candidate.u - candidate.v, candidate.u, candidate.v};
    glm::dvec3 normal(0.0);
    Root root{.position = candidate.position, .triangle = candidate.triangle};
    for (int i = 0; i < 3; ++i) {
        normal += glm::dvec3(surface.normals[v[i]]) * double{w[i]};
        if (!surface.uvs.empty()) root.uv += surface.uvs[v[i]] * w[i];
    }
    root.normal = unit(normal, glm::dvec3(0.0, 1.0, 0.0));
    return root;
}

}  // namespace

std::vector<Root> scatter_roots(const GrowSurface& surface, uint32_t count, uint32_t seed) {
    const double area = haired_area(surface);
    if (!(area > 0.0) || count == 0) return {};
    const auto candidates = draw_candidates(surface, uint64_t{count} * kCandidates, area, seed);
    std::vector<Root> roots;
    roots.reserve(count);
    for (const uint32_t index : progressive_order(candidates, count, area, seed)) {
        roots.push_back(make_root(surface, candidates[index]));
    }
    return roots;
}

}  // namespace vellus::hair::grow
