#include "assets/generator/bust_mesh.h"

#include "assets/generator/bust.h"
#include "assets/generator/decimate.h"
#include "assets/generator/eyeball.h"
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

/// One of the bust's eyes.
Part eyeball(double side) {
    constexpr double kRings[] = {0.0010, 0.0018, 0.0020, 0.0023, 0.0030, 0.0040, 0.0047, 0.0052,
                                 0.0056, 0.0060, 0.0064, 0.0080, 0.0105, 0.0130, 0.0144, 0.0150};
    Part part;
    part.name = side > 0.0 ? "eye_left" : "eye_right";
    part.roughness = 0.08;
    Eyeball eye =
        make_eyeball({kEyeCenter.x * side, kEyeCenter.y, kEyeCenter.z}, kEyeRadius, 32, kRings);
    part.surface = std::move(eye.surface);
    part.colors = std::move(eye.colors);
    part.weights.assign(part.colors.size(), {0.0, 0.0, 1.0});
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
