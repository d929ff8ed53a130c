#include "modules/hair/environment/ambient_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/hair/environment/ambient.h"
#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

namespace {

constexpr float kCells = 96.0f;  // along the longest side
constexpr int kMips = 5;
constexpr float kOpening = 0.7f;    // a step over the way gone so far
constexpr float kSkinBelow = 1.5f;  // cells from a root to the middle of its skin
constexpr float kSkinStep = 0.7f;   // cells
constexpr float kSqrt2 = 1.41421356f;

float volume_of(const AmbientGrid& grid) {
    return grid.cell * grid.cell * grid.cell;
}

/// std::floor is a call without SSE 4.1.
int floor_of(float x) {
    const int cut = static_cast<int>(x);
    return static_cast<float>(cut) > x ? cut - 1 : cut;
}

glm::ivec3 cell_of(const glm::vec3& p) {
    return {floor_of(p.x), floor_of(p.y), floor_of(p.z)};
}

/// Between the centres of eight cells; `p` in cells.
StrandArea strands_at(const AmbientGrid& grid, const glm::vec3& p) {
    const glm::vec3 q = p - 0.5f;
    const glm::ivec3 first = cell_of(q);
    const glm::vec3 f = q - glm::vec3(first);
    const bool inside = glm::all(glm::greaterThanEqual(first, glm::ivec3(0))) &&
                        glm::all(glm::lessThan(first + 1, grid.size));
    StrandArea sum;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 o(corner & 1, (corner >> 1) & 1, corner >> 2);
        if (!inside && !grid.holds(first + o)) continue;
        const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(o));
        sum += grid.strands[grid.index(first + o)].scaled(w.x * w.y * w.z);
    }
    return sum;
}

AmbientGrid empty_grid(const glm::ivec3& size, float cell) {
    AmbientGrid grid{.size = size, .cell = cell, .strands = {}};
    grid.strands.resize(grid.index(size - 1) + 1);
    return grid;
}

/// A piece of a strand of diameter `width`, in steps of half a cell.
void add_segment(const glm::vec3& a, const glm::vec3& along, float width, const glm::vec3& origin,
                 AmbientGrid& grid) {
    const float length = glm::length(along);
    if (length <= 0.0f) return;
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0f * length / grid.cell)));
    const StrandArea piece =
        area_along(along / length, length * width / (volume_of(grid) * static_cast<float>(steps)));
    for (int i = 0; i < steps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps);
        grid.strands[grid.near((a + t * along - origin) / grid.cell)] += piece;
    }
}

void add_strands(const AmbientRoots& strands, const StrandTaper& taper, const glm::vec3& origin,
                 AmbientGrid& grid) {
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

void add_pieces(const AmbientPieces& pieces, const glm::vec3& origin, AmbientGrid& grid) {
    for (size_t i = 0; i < pieces.at.size(); ++i) {
        grid.strands[grid.near((pieces.at[i] - origin) / grid.cell)] +=
            pieces.strands[i].scaled(1.0f / volume_of(grid));
    }
}

/// A disc of skin, one cell thick; `at` and `radius` in cells.
void add_disc(const glm::vec3& at, const glm::vec3& normal, float radius, const AmbientGrid& grid,
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

AmbientGrid halved(const AmbientGrid& from) {
    AmbientGrid grid = empty_grid((from.size + 1) / 2, 2.0f * from.cell);
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
AmbientVolume empty_volume(const AmbientRoots& roots) {
    Bounds bounds;
    for (const glm::vec3& p : roots.points) bounds.add(p);
    const glm::vec3 size = bounds.size();
    const float cell = std::max(std::max({size.x, size.y, size.z}) / kCells, 1e-6f);
    AmbientVolume volume{.origin = bounds.low - cell, .mips = {}};
    volume.mips.push_back(empty_grid(glm::ivec3(glm::ceil(size / cell)) + 2, cell));
    return volume;
}

/// Metres from `from` along `d` to the box [-rim, extent + rim]: 0 inside, infinite past it.
float way_to_box(const glm::vec3& extent, float rim, const glm::vec3& from, const glm::vec3& d) {
    float enter = 0.0f;
    float leave = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (d[i] == 0.0f) {
            if (from[i] < -rim || from[i] > extent[i] + rim) return leave;
            continue;
        }
        const float a = (-rim - from[i]) / d[i];
        const float b = (extent[i] + rim - from[i]) / d[i];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave ? enter : std::numeric_limits<float>::infinity();
}

void add_mips(AmbientVolume& volume) {
    for (int i = 1; i < kMips; ++i) volume.mips.push_back(halved(volume.mips.back()));
}

}  // namespace

AmbientVolume ambient_volume(const AmbientRoots& strands, const StrandTaper& taper) {
    AmbientVolume volume = empty_volume(strands);
    add_strands(strands, taper, volume.origin, volume.mips[0]);
    add_mips(volume);
    return volume;
}

AmbientVolume ambient_volume(const AmbientRoots& cards, const AmbientPieces& pieces) {
    AmbientVolume volume = empty_volume(cards);
    add_pieces(pieces, volume.origin, volume.mips[0]);
    add_mips(volume);
    return volume;
}

void add_skin_below(const AmbientRoots& roots, AmbientVolume& volume) {
    const AmbientGrid& grid = volume.mips[0];
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

void add_skin(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
              AmbientVolume& volume) {
    const AmbientGrid& grid = volume.mips[0];
    volume.skin.resize(grid.strands.size());
    for (const glm::uvec3& t : triangles) {
        const glm::vec3 a = (positions[t.x] - volume.origin) / grid.cell;
        const glm::vec3 b = (positions[t.y] - volume.origin) / grid.cell;
        const glm::vec3 c = (positions[t.z] - volume.origin) / grid.cell;
        if (glm::any(glm::lessThan(glm::max(a, glm::max(b, c)), glm::vec3(0.0f))) ||
            glm::any(glm::greaterThan(glm::min(a, glm::min(b, c)), glm::vec3(grid.size)))) {
            continue;
        }
        const float longest =
            std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        const int parts = std::max(1, static_cast<int>(std::ceil(2.0f * longest)));
        for (int i = 0; i <= parts; ++i) {
            for (int j = 0; i + j <= parts; ++j) {
                const glm::vec3 p =
                    a + (static_cast<float>(i) * (b - a) + static_cast<float>(j) * (c - a)) /
                            static_cast<float>(parts);
                const glm::ivec3 cell = cell_of(p);
                if (grid.holds(cell)) volume.skin[grid.index(cell)] = 1;
            }
        }
    }
}

float skin_along(const AmbientVolume& volume, const glm::vec3& p, const glm::vec3& d) {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    if (volume.skin.empty()) return kNone;
    const AmbientGrid& grid = volume.mips[0];
    const glm::vec3 from = (p - volume.origin) / grid.cell;
    const float near = way_to_box(glm::vec3(grid.size), 0.0f, from, d);
    if (std::isinf(near)) return kNone;
    for (float t = near + kSkinStep;; t += kSkinStep) {
        const glm::ivec3 c = cell_of(from + d * t);
        if (!grid.holds(c)) return kNone;
        if (volume.skin[grid.index(c)] != 0) return t * grid.cell;
    }
}

float depth_along(const AmbientVolume& volume, const glm::vec3& p, const glm::vec3& d, float end) {
    const AmbientGrid& finest = volume.mips[0];
    const glm::vec3 from = p - volume.origin;
    // Wide cells reach beyond the groom by up to a step, with what they hold of its rim.
    const auto outside = [&](const glm::vec3& at, float step) {
        return glm::any(glm::lessThan(at, glm::vec3(-step))) ||
               glm::any(glm::greaterThan(at, volume.extent() + step));
    };
    const float near = way_to_box(volume.extent(), 0.0f, from, d);
    if (std::isinf(near)) return 0.0f;
    float depth = 0.0f;
    for (float t = way_to_box(volume.extent(), kOpening * near, from, d);
         t < end && depth < glsl::kAmbientMost;) {
        const float wide = std::max(finest.cell, kOpening * t);
        const float step = std::min(wide, end - t);
        const glm::vec3 at = from + d * (t + 0.5f * step);
        if (outside(at, step)) {
            if (t > near || near == 0.0f) break;
            t += step;
            continue;
        }
        // The mip whose cells are nearest to that, by ratio.
        size_t mip = 0;
        while (mip + 1 < volume.mips.size() && wide >= volume.mips[mip].cell * kSqrt2) ++mip;
        const AmbientGrid& grid = volume.mips[mip];
        depth += step * strands_at(grid, at / grid.cell).seen(d);
        t += step;
    }
    return depth;
}

}  // namespace vellus::hair
