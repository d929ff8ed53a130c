#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "assets/generator/skeleton.h"
#include "assets/generator/surface_nets.h"

namespace vellus::sculpt {

/// One closed surface of a model with its own material.
struct SkinnedPart {
    std::string name;
    Surface surface;
    /// Linear, one per vertex; the material's colour multiplies them.
    std::vector<glm::dvec3> colors;
    /// One per vertex; empty for a part that does not bend.
    std::vector<Influences> influences;
    glm::dvec3 base_color{1.0};
    double roughness = 0.8;
};

/// How a part is sculpted: its field, meshed on a grid, thinned to `triangles`, painted and bound.
struct PartRecipe {
    std::string name;
    Grid grid;
    Field field;
    glm::dvec3 (*color)(glm::dvec3) = nullptr;
    Influences (*influences)(glm::dvec3) = nullptr;
    size_t triangles = 0;
    glm::dvec3 base_color{1.0};
    double roughness = 0.8;
};

SkinnedPart sculpt_part(const PartRecipe& recipe);

}  // namespace vellus::sculpt
