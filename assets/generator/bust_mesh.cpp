#include "assets/generator/bust_mesh.h"

#include "assets/generator/bust.h"
#include "assets/generator/decimate.h"
#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

Grid skin_grid() {
    return {
        grid_lines(-0.250, {{-0.092, 0.0060},
                            {-0.050, 0.0024},
                            {0.050, 0.0014},
                            {0.092, 0.0024},
                            {0.250, 0.0060}}),
        grid_lines(-0.412, {{-0.240, 0.0060},
                            {-0.125, 0.0035},
                            {-0.085, 0.0020},
                            {0.022, 0.0014},
                            {0.130, 0.0034}}),
        grid_lines(-0.170, {{-0.115, 0.0060}, {0.050, 0.0030}, {0.066, 0.0020}, {0.120, 0.0014}})};
}

Grid cloth_grid() {
    constexpr double kStep = 0.0040;
    return {grid_lines(-0.254, {{0.254, kStep}}), grid_lines(-0.418, {{-0.150, kStep}}),
            grid_lines(-0.176, {{0.110, kStep}})};
}

Surface sculpt(const Grid& grid, const Field& field, dvec3 (*color)(dvec3), size_t triangles) {
    Surface surface = surface_nets(grid, field);
    settle(surface, field);
    std::vector<dvec3> colors;
    for (const dvec3 p : surface.positions) {
        colors.push_back(color(p));
    }
    surface = decimate(surface, colors, triangles);
    settle(surface, field);
    return surface;
}

Part painted(std::string name, Surface surface, dvec3 (*color)(dvec3), double roughness) {
    Part part{std::move(name), std::move(surface), {}, {}, roughness};
    for (const dvec3 p : part.surface.positions) {
        part.colors.push_back(color(p));
        part.weights.push_back(joint_weights(p));
    }
    return part;
}

dvec3 cloth_color(dvec3) {
    return {0.052, 0.074, 0.094};
}

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

/// A sphere of rings around the optical axis, closest together where iris and pupil end.
Part eyeball(double side) {
    Part part;
    part.name = side > 0.0 ? "eye_left" : "eye_right";
    part.roughness = 0.08;
    const dvec3 center(kEyeCenter.x * side, kEyeCenter.y, kEyeCenter.z);
    const std::vector<glm::dvec2> turn = circle(32);
    const double rings[] = {0.0010, 0.0018, 0.0020, 0.0023, 0.0030, 0.0040, 0.0047, 0.0052,
                            0.0056, 0.0060, 0.0064, 0.0080, 0.0105, 0.0130, 0.0144, 0.0150};
    const auto add = [&](dvec3 direction, double radius, bool front) {
        part.surface.positions.push_back(center + direction * kEyeRadius);
        part.surface.normals.push_back(direction);
        part.colors.push_back(eye_color(radius, front));
        part.weights.push_back({0.0, 0.0, 1.0});
    };
    std::vector<std::pair<double, bool>> profile;
    for (const double ring : rings) {
        profile.emplace_back(ring, true);
    }
    for (const double ring : {0.0120, 0.0070}) {
        profile.emplace_back(ring, false);
    }
    add({0.0, 0.0, 1.0}, 0.0, true);
    for (const auto& [radius, front] : profile) {
        const double r = radius / kEyeRadius;
        const double z = std::sqrt(std::max(0.0, 1.0 - r * r)) * (front ? 1.0 : -1.0);
        for (const glm::dvec2 t : turn) {
            add(glm::normalize(dvec3(t.x * r, t.y * r, z)), radius, front);
        }
    }
    add({0.0, 0.0, -1.0}, 0.0, false);

    auto& indices = part.surface.indices;
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
    return part;
}

}  // namespace

std::vector<Part> make_bust() {
    std::vector<Part> parts;
    parts.push_back(
        painted("skin", sculpt(skin_grid(), skin_distance, skin_color, 30'000), skin_color, 0.5));
    parts.push_back(painted("cloth", sculpt(cloth_grid(), cloth_distance, cloth_color, 6'000),
                            cloth_color, 0.9));
    parts.push_back(eyeball(1.0));
    parts.push_back(eyeball(-1.0));
    return parts;
}

}  // namespace vellus::sculpt
