#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "assets/generator/surface_nets.h"

namespace vellus::sculpt {

/// One closed surface of the bust with its own material.
struct Part {
    std::string name;
    Surface surface;
    /// Linear, one per vertex.
    std::vector<glm::dvec3> colors;
    /// Shares of torso, neck and head, one per vertex.
    std::vector<glm::dvec3> weights;
    double roughness = 0.5;
};

/// Skin, cloth and the two eyeballs, about 38,000 triangles.
std::vector<Part> make_bust();

}  // namespace vellus::sculpt
