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
constexpr float kOpening = 0.7f;    // a step over the way gone so far
constexpr float kSkinBelow = 1.5f;  // cells from a root to the middle of its skin
constexpr float kSkinStep = 0.7f;   // cells
constexpr float kMatched = 0.5f;    // share of the optical depth at which means are exact
constexpr float kOwn = 0.4f;        // weight of an axis' own direction
constexpr float kCorner = 0.577350269f;

struct Grid {
    glm::ivec3 size{1};
    float cell = 1.0f;
    std::vector<StrandArea> strands;  ///< per volume

    [[nodiscard]] size_t index(const glm::ivec3& c) const {
        return (static_cast<size_t>(c.z) * static_cast<size_t>(size.y) + static_cast<size_t>(c.y)) *
                   static_cast<size_t>(size.x) +
               static_cast<size_t>(c.x);
    }
    [[nodiscard]] float volume() const { return cell * cell * cell; }
    [[nodiscard]] bool holds(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) &&
               glm::all(glm::lessThan(c, size));
    }
    /// The cell at `p`, in cells, or the nearest to it.
    [[nodiscard]] size_t near(const glm::vec3& p) const {
        return index(glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), size - 1));
    }
    /// Between the centres of eight cells; `p` in cells.
    [[nodiscard]] StrandArea at(const glm::vec3& p) const {
        const glm::vec3 q = p - 0.5f;
        const glm::vec3 low = glm::floor(q);
        const glm::vec3 f = q - low;
        StrandArea sum;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 o(corner & 1, (corner >> 1) & 1, corner >> 2);
            const glm::ivec3 c = glm::ivec3(low) + o;
            if (!holds(c)) continue;
            const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(o));
            sum += strands[index(c)].scaled(w.x * w.y * w.z);
        }
        return sum;
    }
};

struct Volume {
    glm::vec3 origin{0.0f};
    std::vector<Grid> mips;
    std::vector<uint8_t> skin;  ///< by cell of the finest grid; empty where none is known of
};

Grid empty_grid(const glm::ivec3& size, float cell) {
    Grid grid{.size = size, .cell = cell, .strands = {}};
    grid.strands.resize(grid.index(size - 1) + 1);
    return grid;
}

/// Roots of strands or cards: points[begin[i]].
struct Roots {
    std::span<const glm::vec3> points;
    std::span<const uint32_t> begin;

    [[nodiscard]] size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
    [[nodiscard]] glm::vec3 at(size_t i) const { return points[begin[i]]; }
};

/// A piece of a strand of diameter `width`, in steps of half a cell.
void add_segment(const glm::vec3& a, const glm::vec3& along, float width, const glm::vec3& origin,
                 Grid& grid) {
    const float length = glm::length(along);
    if (length <= 0.0f) return;
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0f * length / grid.cell)));
    const StrandArea piece =
        area_along(along / length, length * width / (grid.volume() * static_cast<float>(steps)));
    for (int i = 0; i < steps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps);
        grid.strands[grid.near((a + t * along - origin) / grid.cell)] += piece;
    }
}

void add_strands(const Roots& strands, const StrandTaper& taper, const glm::vec3& origin,
                 Grid& grid) {
    for (size_t s = 0; s < strands.count(); ++s) {
        const std::span points =
            strands.points.subspan(strands.begin[s], strands.begin[s + 1] - strands.begin[s]);
        float whole = 0.0f;
        for (size_t i = 0; i + 1 < points.size(); ++i) {
            whole += glm::distance(points[i], points[i + 1]);
        }
        float past = 0.0f;
        for (size_t i = 0; i + 1 < points.size(); ++i) {
            const glm::vec3 along = points[i + 1] - points[i];
            const float length = glm::length(along);
            const float middle = (past + 0.5f * length) / std::max(whole, 1e-30f);
            add_segment(points[i], along, taper.root * glm::mix(1.0f, taper.tip_scale, middle),
                        origin, grid);
            past += length;
        }
    }
}

void add_pieces(const AmbientPieces& pieces, const glm::vec3& origin, Grid& grid) {
    for (size_t i = 0; i < pieces.at.size(); ++i) {
        grid.strands[grid.near((pieces.at[i] - origin) / grid.cell)] +=
            pieces.strands[i].scaled(1.0f / grid.volume());
    }
}

/// A disc of skin, one cell thick; `at` and `radius` in cells.
void add_disc(const glm::vec3& at, const glm::vec3& normal, float radius, const Grid& grid,
              std::vector<uint8_t>& skin) {
    const int reach = static_cast<int>(std::ceil(radius));
    for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                const glm::vec3 offset(x, y, z);
                const bool inside = glm::dot(offset, offset) <= radius * radius &&
                                    std::abs(glm::dot(offset, normal)) <= 0.6f;
                if (inside) skin[grid.near(at + offset)] = 1;
            }
        }
    }
}

/// Cells just below the roots, where these stand around something.
void add_skin(const Roots& roots, Volume& volume) {
    const Grid& grid = volume.mips[0];
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
    volume.skin.resize(grid.strands.size());
    const glm::vec3 middle(sum / static_cast<double>(roots.count()));
    // Discs with as much area as the ball around the middle leave no holes where hair grows.
    const float share = 2.0f / std::sqrt(static_cast<float>(roots.count()));
    for (size_t i = 0; i < roots.count(); ++i) {
        const glm::vec3 root = roots.at(i);
        const float distance = glm::distance(middle, root);
        if (distance <= 3.0f * grid.cell) continue;
        const glm::vec3 inward = (middle - root) / distance;
        const glm::vec3 below = root + inward * (kSkinBelow * grid.cell);
        add_disc((below - volume.origin) / grid.cell, inward, share * distance / grid.cell, grid,
                 volume.skin);
    }
}

Grid halved(const Grid& from) {
    Grid grid = empty_grid((from.size + 1) / 2, 2.0f * from.cell);
    for (int z = 0; z < from.size.z; ++z) {
        for (int y = 0; y < from.size.y; ++y) {
            for (int x = 0; x < from.size.x; ++x) {
                const glm::ivec3 c(x, y, z);
                grid.strands[grid.index(c / 2)] += from.strands[from.index(c)].scaled(0.125f);
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

/// Metres from `p` to skin; infinite where there is none.
float skin_along(const Volume& volume, const glm::vec3& p, const glm::vec3& d) {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    if (volume.skin.empty()) return kNone;
    const Grid& grid = volume.mips[0];
    const glm::vec3 from = (p - volume.origin) / grid.cell;
    for (float t = kSkinStep;; t += kSkinStep) {
        const glm::ivec3 c(glm::floor(from + d * t));
        if (!grid.holds(c)) return kNone;
        if (volume.skin[grid.index(c)] != 0) return t * grid.cell;
    }
}

/// Outwards from a point: optical depth of hair as far as skin, and whether there is none.
struct Way {
    float depth = 0.0f;
    float open = 1.0f;
};

Way way_along(const Volume& volume, const glm::vec3& p, const glm::vec3& d) {
    const Grid& finest = volume.mips[0];
    const glm::vec3 from = p - volume.origin;
    const glm::vec3 extent = glm::vec3(finest.size) * finest.cell;
    const float end = skin_along(volume, p, d);
    Way way{.open = std::isinf(end) ? 1.0f : 0.0f};
    for (float t = 0.0f; t < end && way.depth < glsl::kAmbientMost;) {
        const float wide = std::max(finest.cell, kOpening * t);
        const float step = std::min(wide, end - t);
        const glm::vec3 at = from + d * (t + 0.5f * step);
        // Wide cells reach beyond the groom by up to a step, with what they hold of its rim.
        if (glm::any(glm::lessThan(at, glm::vec3(-step))) ||
            glm::any(glm::greaterThan(at, extent + step))) {
            break;
        }
        const int mip =
            std::min(static_cast<int>(std::lround(std::log2(wide / finest.cell))), kMips - 1);
        const Grid& grid = volume.mips[static_cast<size_t>(mip)];
        way.depth += step * grid.at(at / grid.cell).seen(d);
        t += step;
    }
    return way;
}

/// Means over ways, in weights that add up to one: of light as it passes the hair, and of openness.
struct Mean {
    float through = 0.0f;
    float open = 0.0f;

    void add(float weight, const Way& way) {
        const float passed = weight * std::exp(-kMatched * way.depth);
        through += passed;
        open += passed * way.open;
    }
};

AxisDepths depths_at(const Volume& volume, const glm::vec3& p) {
    std::array<Way, 8> corners;
    for (size_t i = 0; i < 8; ++i) {
        const glm::vec3 d((i & 1) != 0 ? kCorner : -kCorner, (i & 2) != 0 ? kCorner : -kCorner,
                          (i & 4) != 0 ? kCorner : -kCorner);
        corners[i] = way_along(volume, p, d);
    }
    AxisDepths depths{};
    for (size_t k = 0; k < 6; ++k) {
        const auto axis = static_cast<int>(k % 3);
        const bool positive = k < 3;
        glm::vec3 d(0.0f);
        d[axis] = positive ? 1.0f : -1.0f;
        Mean mean;
        mean.add(kOwn, way_along(volume, p, d));
        for (size_t i = 0; i < 8; ++i) {
            if (((i >> axis) & 1) == (positive ? 1 : 0))
                mean.add(0.25f * (1.0f - kOwn), corners[i]);
        }
        depths.hair[k] =
            std::min(-std::log(std::max(mean.through, 1e-30f)) / kMatched, glsl::kAmbientMost);
        depths.open[k] = mean.through > 0.0f ? mean.open / mean.through : 0.0f;
    }
    return depths;
}

template <class Add>
std::vector<AxisDepths> depths_around(const Roots& roots, const Add& add) {
    std::vector<AxisDepths> depths(roots.points.size());
    if (depths.empty()) return depths;
    Volume volume = empty_volume(roots);
    add(volume.origin, volume.mips[0]);
    add_skin(roots, volume);
    for (int i = 1; i < kMips; ++i) volume.mips.push_back(halved(volume.mips.back()));
    parallel_ranges(depths.size(), 256, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) depths[i] = depths_at(volume, roots.points[i]);
    });
    return depths;
}

}  // namespace

std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> strand_begin,
                                       const StrandTaper& taper) {
    const Roots strands{points, strand_begin};
    return depths_around(strands, [&](const glm::vec3& origin, Grid& grid) {
        add_strands(strands, taper, origin, grid);
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
        for (size_t k = 0; k < 6; ++k) {
            const uint32_t code = glsl::ambient_code(depths[i].hair[k], depths[i].open[k]);
            packed[i][k < 3 ? 0 : 1] |= code << (10 * (k % 3));
        }
    }
    return packed;
}

}  // namespace vellus::hair
