#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// Optical depths of a groom around one of its points along +x, +y, +z, -x, -y, -z: means over the
/// directions nearest to each axis.
using AxisDepths = std::array<float, 6>;

/// How much hair lies around each point, for strands of diameter `width` from root to tip. From a
/// grid of the strands' area, about 100 cells along the longest side, looked through in 14
/// directions with steps that grow with distance. Roots that stand all over something round are
/// taken for its skin, which nothing passes.
std::vector<AxisDepths> ambient_depths(const StrandData& strands, float width);

/// As the shader reads them: six bytes (ambient_code of hair/environment/ambient.glsl) in two
/// words.
std::vector<glm::uvec2> pack_ambient_depths(const std::vector<AxisDepths>& depths);

}  // namespace vellus::hair
