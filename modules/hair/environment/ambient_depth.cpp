#include "modules/hair/environment/ambient_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/platform/jobs.h"
#include "modules/hair/environment/ambient.h"

namespace vellus::hair {

namespace {

constexpr float kCells = 96.0f;  // along the longest side
constexpr int kMips = 5;
constexpr float kOpening = 0.7f;     // a step over the way gone so far
constexpr float kSkinDepth = 30.0f;  // optical depth of a cell of skin
constexpr float kMatched = 0.5f;     // share of the optical depth at which means are exact
constexpr float kCorner = 0.577350269f;

/// Area of strands per volume, 1/metres, as seen along x, y and z.
struct Grid {
    glm::ivec3 size{1};
    float cell = 1.0f;
    std::vector<glm::vec3> area;

    [[nodiscard]] size_t index(const glm::ivec3& c) const {
        return (static_cast<size_t>(c.z) * static_cast<size_t>(size.y) + static_cast<size_t>(c.y)) *
                   static_cast<size_t>(size.x) +
               static_cast<size_t>(c.x);
    }
    [[nodiscard]] float volume() const { return cell * cell * cell; }
    /// The cell at `p`, in cells, or the nearest to it.
    glm::vec3& near(const glm::vec3& p) {
        return area[index(glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), size - 1))];
    }
    /// Between the centres of eight cells; `p` in cells.
    [[nodiscard]] glm::vec3 at(const glm::vec3& p) const {
        const glm::vec3 q = p - 0.5f;
        const glm::vec3 low = glm::floor(q);
        const glm::vec3 f = q - low;
        glm::vec3 sum(0.0f);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 o(corner & 1, (corner >> 1) & 1, corner >> 2);
            const glm::ivec3 c = glm::ivec3(low) + o;
            if (glm::any(glm::lessThan(c, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(c, size))) {
                continue;
            }
            const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(o));
            sum += w.x * w.y * w.z * area[index(c)];
        }
        return sum;
    }
};

struct Volume {
    glm::vec3 origin{0.0f};
    std::vector<Grid> mips;
};

Grid empty_grid(const glm::ivec3& size, float cell) {
    Grid grid{.size = size, .cell = cell, .area = {}};
    grid.area.resize(grid.index(size - 1) + 1);
    return grid;
}

/// Roots of strands or cards: points[begin[i]].
struct Roots {
    std::span<const glm::vec3> points;
    std::span<const uint32_t> begin;

    [[nodiscard]] size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
    [[nodiscard]] glm::vec3 at(size_t i) const { return points[begin[i]]; }
};

void add_segment(const glm::vec3& a, const glm::vec3& along, float width, const glm::vec3& origin,
                 Grid& grid) {
    const float length = glm::length(along);
    if (length <= 0.0f) return;
    const glm::vec3 d = along / length;
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0f * length / grid.cell)));
    const glm::vec3 seen = glm::sqrt(glm::max(1.0f - d * d, 0.0f)) *
                           (length * width / (grid.volume() * static_cast<float>(steps)));
    for (int i = 0; i < steps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps);
        grid.near((a + t * along - origin) / grid.cell) += seen;
    }
}

void add_strands(const Roots& strands, float width, const glm::vec3& origin, Grid& grid) {
    for (size_t s = 0; s < strands.count(); ++s) {
        for (uint32_t i = strands.begin[s]; i + 1 < strands.begin[s + 1]; ++i) {
            const glm::vec3 a = strands.points[i];
            add_segment(a, strands.points[i + 1] - a, width, origin, grid);
        }
    }
}

void add_pieces(const AmbientPieces& pieces, const glm::vec3& origin, Grid& grid) {
    for (size_t i = 0; i < pieces.at.size(); ++i) {
        grid.near((pieces.at[i] - origin) / grid.cell) += pieces.area[i] / grid.volume();
    }
}

/// A disc of skin, one cell thick; `at` and `radius` in cells.
void add_disc(const glm::vec3& at, const glm::vec3& normal, float radius, Grid& grid) {
    const int reach = static_cast<int>(std::ceil(radius));
    for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                const glm::vec3 offset(x, y, z);
                const bool inside = glm::dot(offset, offset) <= radius * radius &&
                                    std::abs(glm::dot(offset, normal)) <= 0.6f;
                if (inside) grid.near(at + offset) = glm::vec3(kSkinDepth / grid.cell);
            }
        }
    }
}

/// Cells just below the roots, where these stand around something.
void add_skin(const Roots& roots, const glm::vec3& origin, Grid& grid) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-low);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < roots.count(); ++i) {
        low = glm::min(low, roots.at(i));
        high = glm::max(high, roots.at(i));
        sum += roots.at(i);
    }
    const glm::vec3 sides = high - low;
    const float longest = std::max({sides.x, sides.y, sides.z});
    if (std::min({sides.x, sides.y, sides.z}) < 0.4f * longest) return;
    const glm::vec3 middle(sum / static_cast<double>(roots.count()));
    // Discs with as much area as the ball around the middle leave no holes where hair grows.
    const float share = 2.0f / std::sqrt(static_cast<float>(roots.count()));
    for (size_t i = 0; i < roots.count(); ++i) {
        const glm::vec3 root = roots.at(i);
        const float distance = glm::distance(middle, root);
        if (distance <= 3.0f * grid.cell) continue;
        const glm::vec3 inward = (middle - root) / distance;
        const glm::vec3 below = root + inward * (2.0f * grid.cell);
        add_disc((below - origin) / grid.cell, inward, share * distance / grid.cell, grid);
    }
}

Grid halved(const Grid& from) {
    Grid grid = empty_grid((from.size + 1) / 2, 2.0f * from.cell);
    for (int z = 0; z < from.size.z; ++z) {
        for (int y = 0; y < from.size.y; ++y) {
            for (int x = 0; x < from.size.x; ++x) {
                const glm::ivec3 c(x, y, z);
                grid.area[grid.index(c / 2)] += 0.125f * from.area[from.index(c)];
            }
        }
    }
    return grid;
}

/// Without area but that of skin.
Volume empty_volume(const Roots& roots) {
    Bounds bounds;
    for (const glm::vec3& p : roots.points) bounds.add(p);
    const glm::vec3 size = bounds.size();
    const float cell = std::max(std::max({size.x, size.y, size.z}) / kCells, 1e-6f);
    Volume volume{.origin = bounds.low - cell, .mips = {}};
    volume.mips.push_back(empty_grid(glm::ivec3(glm::ceil(size / cell)) + 2, cell));
    return volume;
}

/// Optical depth from `p` outwards.
float depth_along(const Volume& volume, const glm::vec3& p, const glm::vec3& d) {
    const Grid& finest = volume.mips[0];
    const glm::vec3 from = p - volume.origin;
    const glm::vec3 extent = glm::vec3(finest.size) * finest.cell;
    const glm::vec3 squared = d * d;
    float depth = 0.0f;
    for (float t = 0.0f;;) {
        const float step = std::max(finest.cell, kOpening * t);
        const glm::vec3 at = from + d * (t + 0.5f * step);
        // Wide cells reach beyond the groom by up to a step, with what they hold of its rim.
        if (glm::any(glm::lessThan(at, glm::vec3(-step))) ||
            glm::any(glm::greaterThan(at, extent + step))) {
            return depth;
        }
        const int mip =
            std::min(static_cast<int>(std::lround(std::log2(step / finest.cell))), kMips - 1);
        const Grid& grid = volume.mips[static_cast<size_t>(mip)];
        depth += step * glm::dot(squared, grid.at(at / grid.cell));
        if (depth > glsl::kAmbientMost) return depth;
        t += step;
    }
}

AxisDepths depths_at(const Volume& volume, const glm::vec3& p) {
    // The corners of a cube and the middles of its sides: a rule of 14 points for the sphere
    // (McLaren 1963), where a side weighs 1/15 and a corner 3/40. By its squared cosine of 1/3 a
    // corner counts for three sides: of each side's mean its own direction has 0.4, a corner 0.15.
    std::array<float, 8> corners{};
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 d((i & 1) != 0 ? kCorner : -kCorner, (i & 2) != 0 ? kCorner : -kCorner,
                          (i & 4) != 0 ? kCorner : -kCorner);
        corners[static_cast<size_t>(i)] = std::exp(-kMatched * depth_along(volume, p, d));
    }
    AxisDepths depths{};
    for (int k = 0; k < 6; ++k) {
        const int axis = k % 3;
        const bool positive = k < 3;
        glm::vec3 d(0.0f);
        d[axis] = positive ? 1.0f : -1.0f;
        float through = 0.4f * std::exp(-kMatched * depth_along(volume, p, d));
        for (int i = 0; i < 8; ++i) {
            if (((i >> axis) & 1) == (positive ? 1 : 0)) {
                through += 0.15f * corners[static_cast<size_t>(i)];
            }
        }
        depths[static_cast<size_t>(k)] =
            std::min(-std::log(std::max(through, 1e-30f)) / kMatched, glsl::kAmbientMost);
    }
    return depths;
}

template <class Add>
std::vector<AxisDepths> depths_around(const Roots& roots, const Add& add) {
    std::vector<AxisDepths> depths(roots.points.size());
    if (depths.empty()) return depths;
    Volume volume = empty_volume(roots);
    add(volume.origin, volume.mips[0]);
    add_skin(roots, volume.origin, volume.mips[0]);
    for (int i = 1; i < kMips; ++i) volume.mips.push_back(halved(volume.mips.back()));
    parallel_ranges(depths.size(), 256, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) depths[i] = depths_at(volume, roots.points[i]);
    });
    return depths;
}

}  // namespace

std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> strand_begin, float width) {
    const Roots strands{points, strand_begin};
    return depths_around(strands, [&](const glm::vec3& origin, Grid& grid) {
        add_strands(strands, width, origin, grid);
    });
}

std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> card_begin,
                                       const AmbientPieces& pieces) {
    return depths_around({points, card_begin}, [&](const glm::vec3& origin, Grid& grid) {
        add_pieces(pieces, origin, grid);
    });
}

std::vector<glm::uvec2> pack_ambient_depths(const std::vector<AxisDepths>& depths) {
    std::vector<glm::uvec2> packed(depths.size());
    for (size_t i = 0; i < depths.size(); ++i) {
        for (int k = 0; k < 6; ++k) {
            const uint32_t code = glsl::ambient_code(depths[i][static_cast<size_t>(k)]);
            packed[i][k / 3] |= code << static_cast<uint32_t>(8 * (k % 3));
        }
    }
    return packed;
}

}  // namespace vellus::hair
