#include "modules/hair/groom/strand_data.h"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <mutex>

#include "engine/platform/jobs.h"
#include "modules/hair/groom/morton.h"

namespace vellus::hair {

namespace {

constexpr size_t kStrandsPerJob = 256;
/// Ends closer than this, in metres, coincide: a hair's diameter is 1e-4.
constexpr double kShortestSegment = 1e-9;
constexpr double kParameterScale = 65535.0;
/// Makes the level of a strand independent of its seed.
constexpr uint32_t kLevelSalt = 0x3C6EF372U;

/// Bijective mixer with low bias (Wellons, "Prospecting for Hash Functions", lowbias32).
uint32_t mix_bits(uint32_t x) {
    x = (x ^ (x >> 16U)) * 0x7feb352dU;
    x = (x ^ (x >> 15U)) * 0x846ca68bU;
    return x ^ (x >> 16U);
}

/// The affine part of a matrix: half the arithmetic of the whole.
struct Placement {
    glm::dmat3 turn{1.0};
    glm::dvec3 move{0.0};

    explicit Placement(const glm::dmat4& matrix) : turn(matrix), move(matrix[3]) {}
    [[nodiscard]] glm::vec3 operator()(glm::vec3 point) const {
        return {turn * glm::dvec3(point) + move};
    }
};

bool coincide(glm::vec3 a, glm::vec3 b) {
    const glm::dvec3 step = glm::dvec3(a) - glm::dvec3(b);
    return glm::dot(step, step) < kShortestSegment * kShortestSegment;
}

/// Calls `visit(point index, position)` for the points of a strand that differ from the one before.
template <class Visit>
void visit_points(const Groom& groom, const Placement& placement, size_t strand,
                  const Visit& visit) {
    glm::vec3 last(0.0f);
    for (uint32_t p = groom.strand_begin[strand]; p < groom.strand_begin[strand + 1]; ++p) {
        const glm::vec3 position = placement(groom.points[p]);
        if (p > groom.strand_begin[strand] && coincide(position, last)) continue;
        last = position;
        visit(p, position);
    }
}

/// The coarsest level that still holds the strand: level i holds a random 2^(-i/2) of all.
uint64_t coarsest_level(uint32_t source) {
    constexpr double kRatio = 0.70710678118654752;
    const double place = (mix_bits(source ^ kLevelSalt) + 1.0) / 4294967296.0;
    uint64_t level = 0;
    for (double share = kRatio; level + 1 < kStrandLevels && place <= share; share *= kRatio) {
        ++level;
    }
    return level;
}

/// Strand indices, coarsest level first, then along a Morton curve through the roots.
std::vector<uint32_t> sort_strands(const Groom& groom) {
    Bounds roots;
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        roots.add(groom.points[groom.strand_begin[strand]]);
    }
    const glm::vec3 size = glm::max(roots.size(), glm::vec3(1e-30f));
    std::vector<uint64_t> keys(groom.strand_count());
    parallel_ranges(keys.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t strand = first; strand < last; ++strand) {
            const glm::vec3 root = groom.points[groom.strand_begin[strand]];
            const uint64_t finer =
                kStrandLevels - 1 - coarsest_level(static_cast<uint32_t>(strand));
            const uint64_t curve = morton_code((root - roots.low) / size) >> 2U;
            keys[strand] = (finer << 60U) | (curve << 32U) | strand;
        }
    });
    oneapi::tbb::parallel_sort(keys.begin(), keys.end());
    std::vector<uint32_t> order(keys.size());
    std::ranges::transform(keys, order.begin(),
                           [](uint64_t key) { return static_cast<uint32_t>(key); });
    return order;
}

/// Sets strand_source and strand_begin: sorted, without strands that have no segment left.
void lay_out_strands(const Groom& groom, const Placement& placement, StrandData& data) {
    const std::vector<uint32_t> order = sort_strands(groom);
    std::vector<uint32_t> counts(order.size());
    parallel_ranges(order.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            uint32_t count = 0;
            visit_points(groom, placement, order[i], [&](uint32_t, glm::vec3) { ++count; });
            counts[i] = count;
        }
    });
    data.strand_begin.assign(1, 0);
    data.strand_begin.reserve(order.size() + 1);
    data.strand_source.reserve(order.size());
    for (size_t i = 0; i < order.size(); ++i) {
        data.skipped_segments += groom.point_count(order[i]) - counts[i];
        if (counts[i] < 2) continue;
        data.strand_source.push_back(order[i]);
        data.strand_begin.push_back(data.strand_begin.back() + counts[i]);
    }
}

/// Which optional columns the groom really needs.
struct Columns {
    bool colors = false;
    bool widths = false;
};

template <class T>
bool varies(const std::vector<T>& column) {
    return std::ranges::any_of(column, [&](const T& value) { return value != column.front(); });
}

Columns choose_columns(const Groom& groom, float width, StrandData& data) {
    data.has_color = has_colors(groom);
    data.width = width;
    if (!groom.points.empty()) data.color = linear_color_at(groom, 0);
    return {.colors = varies(groom.colors) || varies(groom.transparency),
            .widths = varies(groom.thickness)};
}

void resize_columns(const Columns& columns, StrandData& data) {
    const size_t strands = data.strand_source.size();
    const size_t points = data.strand_begin.back();
    data.positions.resize(points);
    data.point_parameter.resize(points);
    if (columns.widths) data.point_width.resize(points);
    if (columns.colors) data.point_color.resize(points);
    data.strand_seed.resize(strands);
    data.strand_uv.resize(strands);
    data.strand_length.resize(strands);
    data.segment_point.resize(points - strands);
    data.segment_strand.resize(points - strands);
}

glm::uvec2 pack_halves(glm::vec4 color) {
    return {glm::packHalf2x16({color.r, color.g}), glm::packHalf2x16({color.b, color.a})};
}

glm::vec2 root_uv(const Groom& groom, uint32_t strand) {
    if (!groom.strand_uvs.empty()) return groom.strand_uvs[strand];
    return groom.point_uvs.empty() ? glm::vec2(0.0f) : groom.point_uvs[groom.strand_begin[strand]];
}

/// Fills the columns of strands; several run at once, each on its own range.
class Filler {
  public:
    Filler(const Groom& groom, const Placement& placement, double unit, StrandData& data)
        : groom_(groom), placement_(placement), unit_(unit), data_(data) {}

    void fill(size_t strand) {
        const uint32_t source = data_.strand_source[strand];
        const uint32_t begin = data_.strand_begin[strand];
        uint32_t to = begin;
        visit_points(groom_, placement_, source, [&](uint32_t from, glm::vec3 position) {
            data_.positions[to] = position;
            if (!data_.point_width.empty()) {
                const double given = thickness_at(groom_, source, from) * unit_;
                data_.point_width[to] = static_cast<float>(
                    given > 0.0 ? std::clamp(given, kThinnestStrand, kThickestStrand)
                                : data_.width);
            }
            if (!data_.point_color.empty()) {
                data_.point_color[to] = pack_halves(linear_color_at(groom_, from));
            }
            bounds_.add(position);
            ++to;
        });
        data_.strand_seed[strand] = mix_bits(source + 1);
        data_.strand_uv[strand] = root_uv(groom_, source);
        fill_lengths(strand);
    }

    void merge_into(StrandData& data) const {
        if (bounds_.empty()) return;
        data.bounds.add(bounds_.low);
        data.bounds.add(bounds_.high);
        data.max_segment_length = std::max(data.max_segment_length, longest_);
    }

  private:
    void fill_lengths(size_t strand) {
        const uint32_t begin = data_.strand_begin[strand];
        const uint32_t end = data_.strand_begin[strand + 1];
        along_.assign(1, 0.0);
        for (uint32_t p = begin; p + 1 < end; ++p) {
            const double length =
                glm::distance(glm::dvec3(data_.positions[p]), glm::dvec3(data_.positions[p + 1]));
            longest_ = std::max(longest_, static_cast<float>(length));
            along_.push_back(along_.back() + length);
            const size_t segment = p - strand;
            data_.segment_point[segment] = p;
            data_.segment_strand[segment] = static_cast<uint32_t>(strand);
        }
        const double scale = kParameterScale / along_.back();
        for (uint32_t p = begin; p < end; ++p) {
            data_.point_parameter[p] =
                static_cast<uint16_t>(std::lround(along_[p - begin] * scale));
        }
        data_.strand_length[strand] = static_cast<float>(along_.back());
    }

    const Groom& groom_;
    const Placement& placement_;
    double unit_;
    StrandData& data_;
    /// Arc length at each point of the strand at hand.
    std::vector<double> along_;
    Bounds bounds_;
    float longest_ = 0.0f;
};

}  // namespace

namespace {

/// Counts the strands of each level, finest first; all columns are filled.
void find_levels(StrandData& data) {
    std::array<uint32_t, kStrandLevels> strands{};
    std::array<double, kStrandLevels> length{};
    for (size_t s = 0; s < data.strand_count(); ++s) {
        for (uint64_t level = 0; level <= coarsest_level(data.strand_source[s]); ++level) {
            ++strands[level];
            length[level] += data.strand_length[s];
        }
    }
    for (size_t level = 0; level < kStrandLevels && strands[level] > 0; ++level) {
        const uint32_t points = data.strand_begin[strands[level]];
        data.levels.push_back({strands[level], points, points - strands[level],
                               static_cast<float>(length[0] / length[level])});
    }
}

}  // namespace

StrandData prepare_strands(const Groom& groom, const glm::dmat4& to_metres, float width) {
    StrandData data;
    const Placement placement(to_metres);
    const double unit = std::cbrt(std::abs(glm::determinant(glm::dmat3(to_metres))));
    lay_out_strands(groom, placement, data);
    resize_columns(choose_columns(groom, width, data), data);
    std::mutex merging;
    parallel_ranges(data.strand_source.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        Filler filler(groom, placement, unit, data);
        for (size_t strand = first; strand < last; ++strand) filler.fill(strand);
        const std::scoped_lock lock(merging);
        filler.merge_into(data);
    });
    find_levels(data);
    return data;
}

}  // namespace vellus::hair
