#include "assets/generator/decimate.h"

#include <algorithm>
#include <array>
#include <queue>

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// Sum of squared distances to planes: x'Ax + 2b'x + c.
struct Quadric {
    glm::dmat3 a{0.0};
    dvec3 b{0.0};
    double c = 0.0;

    void add_plane(dvec3 normal, double offset) {
        a += glm::outerProduct(normal, normal);
        b += normal * offset;
        c += offset * offset;
    }
    Quadric& operator+=(const Quadric& other) {
        a += other.a;
        b += other.b;
        c += other.c;
        return *this;
    }
    [[nodiscard]] double error(dvec3 p) const {
        return std::max(0.0, glm::dot(p, a * p) + 2.0 * glm::dot(b, p) + c);
    }
};

struct Collapse {
    double cost;
    uint32_t keep, drop;
    /// Changes of both vertices when this was computed: stale if they have changed since.
    uint32_t version;
    dvec3 position;

    bool operator<(const Collapse& other) const {
        if (cost != other.cost) {
            return cost > other.cost;
        }
        return std::pair(keep, drop) > std::pair(other.keep, other.drop);
    }
};

using Triangle = std::array<uint32_t, 3>;

class Mesh {
  public:
    Mesh(const Surface& surface, const std::vector<dvec3>& colors)
        : positions_(surface.positions),
          colors_(colors),
          triangles_(surface.indices.size() / 3),
          faces_of_(surface.positions.size()),
          quadrics_(surface.positions.size()),
          versions_(surface.positions.size()),
          live_(triangles_.size()) {
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            for (size_t i = 0; i < 3; ++i) {
                triangles_[t][i] = surface.indices[3 * t + i];
                faces_of_[triangles_[t][i]].push_back(t);
            }
            const dvec3 normal = normal_of_face(triangles_[t]);
            const double offset = -glm::dot(normal, positions_[triangles_[t][0]]);
            for (const uint32_t v : triangles_[t]) {
                quadrics_[v].add_plane(normal, offset);
            }
        }
    }

    void reduce_to(size_t triangles) {
        for (uint32_t v = 0; v < positions_.size(); ++v) {
            for (const uint32_t other : neighbours(v)) {
                if (v < other) {
                    push(v, other);
                }
            }
        }
        while (live_ > triangles && !queue_.empty()) {
            const Collapse next = queue_.top();
            queue_.pop();
            if (next.version == versions_[next.keep] + versions_[next.drop] && allowed(next)) {
                apply(next);
            }
        }
    }

    [[nodiscard]] Surface surface() const {
        Surface result;
        std::vector<uint32_t> index(positions_.size(), 0);
        for (uint32_t v = 0; v < positions_.size(); ++v) {
            if (!faces_of_[v].empty()) {
                index[v] = static_cast<uint32_t>(result.positions.size());
                result.positions.push_back(positions_[v]);
            }
        }
        for (const Triangle& t : triangles_) {
            if (t[0] != t[1]) {
                result.indices.insert(result.indices.end(),
                                      {index[t[0]], index[t[1]], index[t[2]]});
            }
        }
        return result;
    }

  private:
    [[nodiscard]] dvec3 normal_of_face(const Triangle& t) const {
        const dvec3 n =
            glm::cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
        const double length = glm::length(n);
        return length > 0.0 ? n / length : dvec3(0.0);
    }

    [[nodiscard]] std::vector<uint32_t> neighbours(uint32_t v) const {
        std::vector<uint32_t> result;
        for (const uint32_t t : faces_of_[v]) {
            for (const uint32_t other : triangles_[t]) {
                if (other != v) {
                    result.push_back(other);
                }
            }
        }
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    void push(uint32_t keep, uint32_t drop) {
        Quadric sum = quadrics_[keep];
        sum += quadrics_[drop];
        const dvec3 a = positions_[keep];
        const dvec3 b = positions_[drop];
        // A step of 1 in colour weighs as much as one of 2.5 mm in shape.
        const dvec3 tone = (colors_[keep] - colors_[drop]) * 2.5e-3;
        const dvec3 edge = (a - b) * 2e-2;
        Collapse best{0.0, keep, drop, versions_[keep] + versions_[drop], a};
        best.cost = sum.error(a);
        for (const dvec3 candidate : {b, (a + b) * 0.5}) {
            const double error = sum.error(candidate);
            if (error < best.cost) {
                best.cost = error;
                best.position = candidate;
            }
        }
        best.cost += glm::dot(tone, tone) + glm::dot(edge, edge);
        queue_.push(best);
    }

    /// Whether the surface stays manifold and no triangle turns over or becomes a sliver.
    [[nodiscard]] bool allowed(const Collapse& c) const {
        const std::vector<uint32_t> a = neighbours(c.keep);
        const std::vector<uint32_t> b = neighbours(c.drop);
        std::vector<uint32_t> common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        if (!std::binary_search(a.begin(), a.end(), c.drop) || common.size() != 2 ||
            a.size() + b.size() < 9) {
            return false;
        }
        return keeps_shape(c.keep, c.drop, c.position) && keeps_shape(c.drop, c.keep, c.position);
    }

    [[nodiscard]] bool keeps_shape(uint32_t moved, uint32_t other, dvec3 position) const {
        for (const uint32_t t : faces_of_[moved]) {
            std::array<dvec3, 3> p{};
            bool vanishes = false;
            for (size_t i = 0; i < 3; ++i) {
                vanishes |= triangles_[t][i] == other;
                p[i] = triangles_[t][i] == moved ? position : positions_[triangles_[t][i]];
            }
            if (vanishes) {
                continue;
            }
            const dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double area = glm::length(n);
            const double longest = std::max(
                {glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
            if (area < 0.12 * longest * longest ||
                glm::dot(n, normal_of_face(triangles_[t])) < 0.5 * area) {
                return false;
            }
        }
        return true;
    }

    void apply(const Collapse& c) {
        positions_[c.keep] = c.position;
        quadrics_[c.keep] += quadrics_[c.drop];
        colors_[c.keep] = (colors_[c.keep] + colors_[c.drop]) * 0.5;
        std::vector<uint32_t> kept;
        const auto collect = [&](uint32_t t) {
            Triangle& triangle = triangles_[t];
            std::replace(triangle.begin(), triangle.end(), c.drop, c.keep);
            if (std::count(triangle.begin(), triangle.end(), c.keep) == 1) {
                kept.push_back(t);
                return;
            }
            for (const uint32_t v : triangle) {
                std::erase(faces_of_[v], t);
            }
            triangle = {};
            --live_;
        };
        const std::vector<uint32_t> dropped_faces = faces_of_[c.drop];
        for (const uint32_t t : dropped_faces) {
            collect(t);
        }
        faces_of_[c.drop].clear();
        auto& faces = faces_of_[c.keep];
        faces.insert(faces.end(), kept.begin(), kept.end());
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        ++versions_[c.drop];
        ++versions_[c.keep];
        for (const uint32_t other : neighbours(c.keep)) {
            push(c.keep, other);
        }
    }

    std::vector<dvec3> positions_;
    std::vector<dvec3> colors_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<uint32_t>> faces_of_;
    std::vector<Quadric> quadrics_;
    std::vector<uint32_t> versions_;
    size_t live_;
    std::priority_queue<Collapse> queue_;
};

}  // namespace

Surface decimate(const Surface& surface, const std::vector<dvec3>& colors, size_t triangles) {
    Mesh mesh(surface, colors);
    mesh.reduce_to(triangles);
    return mesh.surface();
}

}  // namespace vellus::sculpt
