#pragma once

#include "modules/hair/components.h"

namespace vellus::hair {

/// Linear colours at root and tip; the groom's column of colours, where it counts, multiplies them.
struct RootTipColors {
    glm::vec3 root{0.0f};
    glm::vec3 tip{0.0f};
};

/// The groom's own colours where it has some and the material takes them, else the material's.
RootTipColors root_tip_colors(const LibraryGroom& groom, const HairMaterial& material);

/// Linear colour of the strands on average, by the same rule.
glm::vec3 mean_color(const LibraryGroom& groom, const HairMaterial& material);

}  // namespace vellus::hair
