#include "modules/hair/grow/grow.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/platform/jobs.h"
#include "modules/hair/grow/chance.h"
#include "modules/hair/grow/fullness.h"
#include "modules/hair/grow/shape.h"

namespace vellus::hair {

namespace {

using namespace grow;

constexpr double kSquareCentimetre = 1e-4;
/// Enough to tell where the head is.
constexpr uint32_t kHeadRoots = 1024;

uint32_t strand_count(const GrowSettings& settings, double area) {
    if (settings.count > 0) return settings.count;
    const double count = settings.density * area / kSquareCentimetre;
    return static_cast<uint32_t>(std::clamp(count, 1.0, double{kMostStrands}));
}

Result<void> check_surface(const GrowSurface& surface) {
    const size_t vertices = surface.positions.size();
    const bool fits =
        surface.normals.size() == vertices && surface.density.size() == vertices &&
        (surface.uvs.empty() || surface.uvs.size() == vertices) &&
        std::ranges::all_of(surface.triangles, [&](uint32_t v) { return v < vertices; });
    if (!fits)
        return Error{"columns of different lengths, or an index out of range", "surface", ""};
    if (!(haired_area(surface) > 0.0)) {
        return Error{"no skin is haired", "surface", "choose a region with some area"};
    }
    return {};
}

/// The file's column of diameters: tapered from root to tip.
void add_thickness(const GrowSettings& settings, Groom& groom) {
    groom.default_thickness = settings.width;
    if (settings.taper <= 0.0f) return;
    const size_t points = settings.points;
    groom.thickness.resize(groom.points.size());
    for (size_t i = 0; i < groom.thickness.size(); ++i) {
        const float t = static_cast<float>(i % points) / static_cast<float>(points - 1);
        // Hair keeps its width for half its length.
        const float gone = std::max(0.0f, 2.0f * t - 1.0f);
        groom.thickness[i] = settings.width * (1.0f - settings.taper * gone * gone);
    }
}

/// Points that fell together while settling are drawn apart, so that every segment has a direction:
/// one goes halfway to the next, a tip on by a millimetre's tenth.
void part_points(std::span<glm::vec3> strand) {
    constexpr float kApart = 1e-6f;  // metres
    for (size_t i = 1; i < strand.size(); ++i) {
        if (glm::distance(strand[i], strand[i - 1]) > kApart) continue;
        if (i + 1 < strand.size() && glm::distance(strand[i + 1], strand[i - 1]) > kApart) {
            strand[i] = 0.5f * (strand[i - 1] + strand[i + 1]);
        } else {
            strand[i] = strand[i - 1] + glm::vec3(0.0f, -1e-4f, 0.0f);
        }
    }
}

Groom to_groom(const GrowSettings& settings, const std::vector<Root>& roots, bool mapped,
               Strands&& strands) {
    Groom groom;
    groom.format = GroomFormat::kGltf;
    groom.points = std::move(strands.at);
    groom.strand_begin.resize(roots.size() + 1);
    for (size_t i = 0; i < groom.strand_begin.size(); ++i) {
        groom.strand_begin[i] = static_cast<uint32_t>(i * settings.points);
    }
    for (size_t i = 0; i < roots.size(); ++i) {
        part_points(std::span(groom.points).subspan(i * settings.points, settings.points));
    }
    if (mapped) {
        for (const Root& root : roots) groom.strand_uvs.push_back(root.uv);
    }
    add_thickness(settings, groom);
    groom.info = fmt::format("Vellus, {}", grow_style_name(settings.style));
    return groom;
}

/// Distances from the parting, by whose sign hair falls to one side. Next to the parting chance has
/// its say: hair that crosses it covers the skin.
std::vector<double> choose_sides(const Ground& ground, const std::vector<Root>& roots) {
    constexpr double kCrossing = 0.03;  // radii of the head
    std::vector<double> sides(roots.size());
    if (!(ground.settings.parted > 0.0f)) return sides;
    for (size_t i = 0; i < roots.size(); ++i) {
        sides[i] = from_parting(ground.head, ground.settings, roots[i].position) +
                   kCrossing * spread(ground.seed, static_cast<uint32_t>(i), 8);
    }
    return sides;
}

bool is_gathered(GrowStyle style) {
    return style == GrowStyle::kPonytail || style == GrowStyle::kBraid;
}

}  // namespace

Result<Groom> grow_groom(const GrowSurface& surface, const GrowSettings& settings, uint32_t seed,
                         const GrowProgress& progress) {
    if (auto ok = check(settings); !ok) return ok.error();
    if (auto ok = check_surface(surface); !ok) return ok.error();
    const auto tell = [&](float share) {
        if (progress) progress(share);
    };
    tell(0.0f);
    const double area = haired_area(surface);
    const Head head = fit_head(scatter_roots(surface, kHeadRoots, seed));
    const std::vector<Root> roots = scatter_roots(fuller_where_hair_parts(surface, head, settings),
                                                  strand_count(settings, area), seed);
    if (roots.empty()) return Error{"no hair found a place", "surface", "choose a larger region"};
    tell(0.15f);
    const ClosestPoint body(surface);
    const Ground ground{body, head, settings, seed};
    std::optional<Gather> gather;
    if (is_gathered(settings.style)) gather = make_gather(body, ground.head, settings);
    tell(0.2f);

    std::vector<Guide> guides(std::min<size_t>(settings.guides, roots.size()));
    parallel_ranges(guides.size(), 4, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            guides[i] = trace_guide(ground, roots[i], static_cast<uint32_t>(i), gather);
        }
    });
    tell(0.4f);
    const std::vector<double> sides = choose_sides(ground, roots);
    const auto neighbours = find_neighbours(roots, sides, guides.size());
    Strands strands = interpolate(ground, roots, guides, neighbours, gather);
    tell(0.6f);
    const Locks locks = find_locks(settings, area, roots, sides);
    if (!gather) clump(ground, locks, strands);
    tell(0.7f);
    curl_and_settle(ground, locks, roots, gather.has_value(), strands);
    tell(1.0f);
    return to_groom(settings, roots, !surface.uvs.empty(), std::move(strands));
}

}  // namespace vellus::hair
