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
constexpr float kMatched = 0.4f;     // share of the optical depth at which means are exact
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

void add_strands(const StrandData& strands, float width, const glm::vec3& origin, Grid& grid) {
    const float volume = grid.cell * grid.cell * grid.cell;
    for (const uint32_t first : strands.segment_point) {
        const glm::vec3 a = strands.positions[first];
        const glm::vec3 along = strands.positions[first + 1] - a;
        const float length = glm::length(along);
        if (length <= 0.0f) continue;
        const glm::vec3 d = along / length;
        const int steps = std::max(1, static_cast<int>(std::ceil(2.0f * length / grid.cell)));
        const glm::vec3 seen = glm::sqrt(glm::max(1.0f - d * d, 0.0f)) *
                               (length * width / (volume * static_cast<float>(steps)));
        for (int i = 0; i < steps; ++i) {
            const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps);
            const glm::ivec3 c((a + t * along - origin) / grid.cell);
            grid.area[grid.index(glm::clamp(c, glm::ivec3(0), grid.size - 1))] += seen;
        }
    }
}

/// Cells just below the roots, where these stand around something.
void add_skin(const StrandData& strands, const glm::vec3& origin, Grid& grid) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-low);
    glm::dvec3 sum(0.0);
    for (size_t s = 0; s < strands.strand_count(); ++s) {
        const glm::vec3 root = strands.positions[strands.strand_begin[s]];
        low = glm::min(low, root);
        high = glm::max(high, root);
        sum += root;
    }
    const glm::vec3 sides = high - low;
    const float longest = std::max({sides.x, sides.y, sides.z});
    if (std::min({sides.x, sides.y, sides.z}) < 0.4f * longest) return;
    const glm::vec3 middle(sum / static_cast<double>(strands.strand_count()));
    for (size_t s = 0; s < strands.strand_count(); ++s) {
        const glm::vec3 root = strands.positions[strands.strand_begin[s]];
        const float distance = glm::distance(middle, root);
        if (distance <= 3.0f * grid.cell) continue;
        const glm::vec3 below = root + (middle - root) * (2.0f * grid.cell / distance);
        const glm::ivec3 c((below - origin) / grid.cell);
        grid.area[grid.index(glm::clamp(c, glm::ivec3(0), grid.size - 1))] =
            glm::vec3(kSkinDepth / grid.cell);
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

Volume build_volume(const StrandData& strands, float width) {
    const glm::vec3 size = strands.bounds.size();
    const float cell = std::max(std::max({size.x, size.y, size.z}) / kCells, 1e-6f);
    Volume volume{.origin = strands.bounds.low - cell, .mips = {}};
    volume.mips.push_back(empty_grid(glm::ivec3(glm::ceil(size / cell)) + 2, cell));
    add_strands(strands, width, volume.origin, volume.mips[0]);
    add_skin(strands, volume.origin, volume.mips[0]);
    for (int i = 1; i < kMips; ++i) volume.mips.push_back(halved(volume.mips.back()));
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

}  // namespace

std::vector<AxisDepths> ambient_depths(const StrandData& strands, float width) {
    std::vector<AxisDepths> depths(strands.positions.size());
    if (strands.segment_count() == 0) return depths;
    const Volume volume = build_volume(strands, width);
    parallel_ranges(depths.size(), 256, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) depths[i] = depths_at(volume, strands.positions[i]);
    });
    return depths;
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
