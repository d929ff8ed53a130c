#include "assets/generator/eyeball.h"

#include <utility>

#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// Colour of the eye at a distance in metres from the optical axis.
dvec3 eye_color(double radius, bool front) {
    const dvec3 white(0.72, 0.68, 0.64);
    if (!front) {
        return white;
    }
    const dvec3 pupil(0.004);
    const dvec3 inner(0.23, 0.125, 0.045);
    const dvec3 outer(0.085, 0.050, 0.026);
    const dvec3 limbus(0.018, 0.014, 0.011);
    dvec3 color = glm::mix(inner, outer, smoothstep(0.0023, 0.0048, radius));
    color = glm::mix(pupil, color, smoothstep(0.0019, 0.0023, radius));
    color = glm::mix(color, limbus, smoothstep(0.0047, 0.0055, radius));
    return glm::mix(color,
                    glm::mix(white, dvec3(0.62, 0.50, 0.46), smoothstep(0.008, 0.0135, radius)),
                    smoothstep(0.0056, 0.0063, radius));
}

/// Cosine and sine of steps of one full turn over `count`, by repeated rotation.
std::vector<glm::dvec2> circle(int count) {
    // Half-angle steps from a quarter turn would need trigonometry; a chord bisection does not.
    std::vector<glm::dvec2> points{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
    while (static_cast<int>(points.size()) < count) {
        std::vector<glm::dvec2> finer;
        for (size_t i = 0; i < points.size(); ++i) {
            finer.push_back(points[i]);
            finer.push_back(glm::normalize(points[i] + points[(i + 1) % points.size()]));
        }
        points = std::move(finer);
    }
    return points;
}

}  // namespace

Eyeball make_eyeball(dvec3 center, double radius, int sides, std::span<const double> rings) {
    Eyeball eye;
    const std::vector<glm::dvec2> turn = circle(sides);
    const auto add = [&](dvec3 direction, double from_axis, bool front) {
        eye.surface.positions.push_back(center + direction * radius);
        eye.surface.normals.push_back(direction);
        eye.colors.push_back(eye_color(from_axis, front));
    };
    std::vector<std::pair<double, bool>> profile;
    for (const double ring : rings) {
        profile.emplace_back(ring, true);
    }
    for (const double ring : {0.0120, 0.0070}) {
        profile.emplace_back(ring, false);
    }
    add({0.0, 0.0, 1.0}, 0.0, true);
    for (const auto& [from_axis, front] : profile) {
        const double r = from_axis / radius;
        const double z = std::sqrt(std::max(0.0, 1.0 - r * r)) * (front ? 1.0 : -1.0);
        for (const glm::dvec2 t : turn) {
            add(glm::normalize(dvec3(t.x * r, t.y * r, z)), from_axis, front);
        }
    }
    add({0.0, 0.0, -1.0}, 0.0, false);

    auto& indices = eye.surface.indices;
    const auto n = static_cast<uint32_t>(turn.size());
    const auto rows = static_cast<uint32_t>(profile.size());
    const auto vertex = [&](uint32_t row, uint32_t i) { return 1 + row * n + i % n; };
    for (uint32_t i = 0; i < n; ++i) {
        indices.insert(indices.end(), {0, vertex(0, i), vertex(0, i + 1)});
        for (uint32_t row = 0; row + 1 < rows; ++row) {
            indices.insert(indices.end(),
                           {vertex(row, i), vertex(row + 1, i), vertex(row + 1, i + 1),
                            vertex(row, i), vertex(row + 1, i + 1), vertex(row, i + 1)});
        }
        indices.insert(indices.end(), {vertex(rows - 1, i), 1 + rows * n, vertex(rows - 1, i + 1)});
    }
    return eye;
}

}  // namespace vellus::sculpt
