#include "assets/generator/part.h"

#include <algorithm>

#include "assets/generator/decimate.h"

namespace vellus::sculpt {

namespace {

/// Whether no edge is run twice in the same direction.
bool is_manifold(const Surface& surface) {
    std::vector<uint64_t> edges;
    for (size_t i = 0; i < surface.indices.size(); ++i) {
        const uint32_t next = surface.indices[i % 3 == 2 ? i - 2 : i + 1];
        edges.push_back(uint64_t{surface.indices[i]} << 32U | next);
    }
    std::ranges::sort(edges);
    return std::ranges::adjacent_find(edges) == edges.end();
}

void shift(std::vector<double>& lines, double by) {
    for (double& line : lines) {
        line += by;
    }
}

/// Where the surface grazes a grid plane two sheets can meet in one cell: then the grid moves a
/// little.
Surface closed_surface(Grid grid, const Field& field) {
    constexpr int kAttempts = 12;
    constexpr double kStep = 0.0011;
    Surface surface = surface_nets(grid, field);
    for (int i = 1; i < kAttempts && !is_manifold(surface); ++i) {
        // Grid lines keep their mirror images.
        shift(grid.y, kStep * (i % 2 == 0 ? -i : i));
        shift(grid.z, kStep * (i % 2 == 0 ? -i : i));
        surface = surface_nets(grid, field);
    }
    return surface;
}

}  // namespace

SkinnedPart sculpt_part(const PartRecipe& recipe) {
    SkinnedPart part{
        recipe.name,     closed_surface(recipe.grid, recipe.field), {}, {}, recipe.base_color,
        recipe.roughness};
    Surface& surface = part.surface;
    settle(surface, recipe.field);
    std::vector<glm::dvec3> colors;
    for (const glm::dvec3 p : surface.positions) {
        colors.push_back(recipe.color(p));
    }
    surface = decimate(surface, colors, recipe.triangles);
    settle(surface, recipe.field);
    for (const glm::dvec3 p : surface.positions) {
        part.colors.push_back(recipe.color(p));
        if (recipe.influences != nullptr) {
            part.influences.push_back(recipe.influences(p));
        }
    }
    return part;
}

}  // namespace vellus::sculpt
