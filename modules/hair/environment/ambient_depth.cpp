#include "modules/hair/environment/ambient_depth.h"

#include <algorithm>
#include <cmath>

#include "engine/platform/jobs.h"
#include "modules/hair/environment/ambient.h"

namespace vellus::hair {

namespace {

constexpr float kMatched = 0.5f;  // share of the optical depth at which means are exact
constexpr float kOwn = 0.4f;      // weight of an axis' own direction
constexpr float kCorner = 0.577350269f;

/// Outwards from a point: optical depth of hair as far as skin, and whether there is none.
struct Way {
    float depth = 0.0f;
    float open = 1.0f;
};

Way way_along(const AmbientVolume& volume, const glm::vec3& p, const glm::vec3& d) {
    const float end = skin_along(volume, p, d);
    return {.depth = depth_along(volume, p, d, end), .open = std::isinf(end) ? 1.0f : 0.0f};
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

AxisDepths depths_at(const AmbientVolume& volume, const glm::vec3& p) {
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

template <class Stops>
std::vector<AxisDepths> depths_around(const AmbientRoots& roots, const Stops& stops) {
    if (roots.points.empty()) return {};
    AmbientVolume volume = ambient_volume(roots, stops);
    add_skin_below(roots, volume);
    return ambient_depths(volume, roots.points);
}

}  // namespace

std::vector<AxisDepths> ambient_depths(const AmbientVolume& volume,
                                       std::span<const glm::vec3> points) {
    std::vector<AxisDepths> depths(points.size());
    parallel_ranges(depths.size(), 256, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) depths[i] = depths_at(volume, points[i]);
    });
    return depths;
}

std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> strand_begin,
                                       const StrandTaper& taper) {
    return depths_around({points, strand_begin}, taper);
}

std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> card_begin,
                                       const AmbientPieces& pieces) {
    return depths_around({points, card_begin}, pieces);
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
