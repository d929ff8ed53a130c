#include "modules/hair/groom/upright.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vellus::hair {

namespace {

constexpr double kScalpSize = 0.17;
constexpr double kSmallestScalp = 0.10;
constexpr double kLargestScalp = 0.30;
/// Size of a groom that is surely meant in metres.
constexpr double kSmallestGroom = 0.02;
constexpr double kLargestGroom = 3.0;
/// Share of a strand's length by which its tip lies below its root.
constexpr double kHangsNot = 0.1;
constexpr double kHangs = 0.6;
/// Mean of unit vectors towards the low roots below which no side is the front.
constexpr double kClearFront = 0.05;
constexpr double kCoverLayers = 8.0;
constexpr double kThinnest = 0.06e-3;
constexpr double kThickest = 1.5e-3;

/// What the heuristics look at, in the file's axes and unit.
struct Shape {
    Bounds box;
    Bounds roots;
    glm::dvec3 root_to_tip{0.0};
    double mean_length = 0.0;
    double total_length = 0.0;
};

Shape measure(const Groom& groom) {
    Shape shape;
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        if (groom.point_count(strand) == 0) continue;
        const uint32_t first = groom.strand_begin[strand];
        const uint32_t last = groom.strand_begin[strand + 1] - 1;
        shape.roots.add(groom.points[first]);
        shape.root_to_tip += glm::dvec3(groom.points[last]) - glm::dvec3(groom.points[first]);
        for (uint32_t p = first; p <= last; ++p) shape.box.add(groom.points[p]);
        for (uint32_t p = first; p < last; ++p) {
            shape.total_length +=
                glm::length(glm::dvec3(groom.points[p + 1]) - glm::dvec3(groom.points[p]));
        }
    }
    const auto strands = static_cast<double>(std::max<size_t>(1, groom.strand_count()));
    shape.root_to_tip /= strands;
    shape.mean_length = shape.total_length / strands;
    return shape;
}

struct Choice {
    int up = 1;
    std::string reason;
};

Choice choose_up(const Groom& groom, const Shape& shape) {
    if (groom.format != GroomFormat::kHair) return {1, "Y up as its format says"};
    const glm::dvec3 drop = -shape.root_to_tip / std::max(shape.mean_length, 1e-30);
    if (drop.z < kHangsNot && drop.y > kHangs) return {1, "Y up, for its hair hangs along -Y"};
    return {2, "Z up as .hair files are"};
}

struct Unit {
    double metres = 1.0;
    std::string reason;
};

Unit choose_unit(const Groom& groom, const Shape& shape, int up) {
    const glm::dvec3 scalp = glm::dvec3(shape.roots.size());
    const glm::dvec3 box = glm::dvec3(shape.box.size());
    const double width = (scalp.x + scalp.y + scalp.z - scalp[up]) / 2.0;
    const double largest = std::max({box.x, box.y, box.z});
    const bool named = groom.format == GroomFormat::kHair;
    const double unit = named ? 0.01 : 1.0;
    if (!(largest > 0.0)) return {unit, "unit of its format"};
    // Roots in a row or on a point tell nothing of a head.
    const bool scalp_known = width > 0.05 * largest;
    const bool size_fits = largest * unit >= kSmallestGroom && largest * unit <= kLargestGroom;
    const bool scalp_fits = width * unit >= kSmallestScalp && width * unit <= kLargestScalp;
    if (size_fits && (!named || !scalp_known || scalp_fits)) {
        return {unit, named ? "unit 1 cm" : "unit 1 m"};
    }
    const double metres = scalp_known ? kScalpSize / width : 2.0 * kScalpSize / largest;
    return {metres, fmt::format("unit {:.3g} m, which makes its {} {:.2f} m", metres,
                                scalp_known ? "scalp" : "size",
                                scalp_known ? kScalpSize : 2.0 * kScalpSize)};
}

/// Mean direction from the middle of the scalp to the roots in its lower half: the back of the
/// head, for the hairline is highest above the face.
glm::dvec2 towards_low_roots(const Groom& groom, const Shape& shape, int up) {
    const glm::dvec3 center = glm::dvec3(shape.roots.center());
    const int right = up == 2 ? 0 : 2;
    const int other = up == 2 ? 1 : 0;
    glm::dvec2 sum(0.0);
    double count = 0.0;
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        if (groom.point_count(strand) == 0) continue;
        const glm::dvec3 offset = glm::dvec3(groom.points[groom.strand_begin[strand]]) - center;
        const glm::dvec2 flat(offset[right], offset[other]);
        const double distance = glm::length(flat);
        if (offset[up] >= 0.0 || distance == 0.0) continue;
        sum += flat / distance;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : glm::dvec2(0.0);
}

/// Rows are the file's directions that become +X, +Y and +Z.
glm::dmat3 axes_to_rows(glm::dvec3 up, glm::dvec3 front) {
    return glm::transpose(glm::dmat3(glm::cross(up, front), up, front));
}

struct Front {
    glm::dvec3 direction{0.0, 0.0, 1.0};
    std::string reason;
};

Front choose_front(const Groom& groom, const Shape& shape, int up) {
    if (groom.format != GroomFormat::kHair) return {{0.0, 0.0, 1.0}, "faces +Z"};
    const glm::dvec2 back = towards_low_roots(groom, shape, up);
    Front front;
    front.direction = up == 2 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    front.reason = up == 2 ? "faces +Y by convention" : "faces +Z by convention";
    if (glm::length(back) < kClearFront) return front;
    const bool along_first = std::abs(back.x) > std::abs(back.y);
    const int axis = up == 2 ? (along_first ? 0 : 1) : (along_first ? 2 : 0);
    const double sign = (along_first ? back.x : back.y) > 0.0 ? -1.0 : 1.0;
    front.direction = glm::dvec3(0.0);
    front.direction[axis] = sign;
    front.reason = fmt::format("faces {}{}, where its hairline is highest", sign > 0.0 ? '+' : '-',
                               "XYZ"[axis]);
    return front;
}

/// Smallest box around a transformed box.
void transform_box(const glm::dmat4& matrix, const Bounds& box, glm::dvec3& low, glm::dvec3& high) {
    if (box.empty()) return;
    const glm::dvec3 a(matrix * glm::dvec4(box.low, 1.0));
    const glm::dvec3 b(matrix * glm::dvec4(box.high, 1.0));
    low = glm::min(a, b);
    high = glm::max(a, b);
}

}  // namespace

Upright upright_transform(const Groom& groom) {
    const Shape shape = measure(groom);
    const Choice up = choose_up(groom, shape);
    const Unit unit = choose_unit(groom, shape, up.up);
    const Front front = choose_front(groom, shape, up.up);
    glm::dvec3 up_direction(0.0);
    up_direction[up.up] = 1.0;

    Upright upright;
    upright.metres_per_unit = unit.metres;
    upright.to_metres = glm::dmat4(axes_to_rows(up_direction, front.direction) * unit.metres);
    upright.to_metres[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
    transform_box(upright.to_metres, shape.roots, upright.scalp_low, upright.scalp_high);
    transform_box(upright.to_metres, shape.box, upright.low, upright.high);
    upright.reason = fmt::format("{}; {}; {}", up.reason, unit.reason, front.reason);
    return upright;
}

double default_width(const Groom& groom, double metres_per_unit) {
    double given = groom.default_thickness;
    if (!groom.thickness.empty()) {
        given = 0.0;
        for (const float value : groom.thickness) given += value;
        given /= static_cast<double>(groom.thickness.size());
    }
    if (given > 0.0) return std::clamp(given * metres_per_unit, kThinnestStrand, kThickestStrand);

    const Shape shape = measure(groom);
    const glm::dvec3 size = glm::dvec3(shape.box.size()) * metres_per_unit;
    const double length = shape.total_length * metres_per_unit;
    // Mean of the three views of the ellipsoid inside the box.
    const double area =
        std::numbers::pi / 4.0 * (size.x * size.y + size.y * size.z + size.z * size.x) / 3.0;
    if (!(length > 0.0)) return kThinnest;
    return std::clamp(kCoverLayers * area / length, kThinnest, kThickest);
}

}  // namespace vellus::hair
