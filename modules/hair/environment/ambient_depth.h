#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "modules/hair/environment/ambient_pieces.h"
#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// Optical depths of a groom around one of its points along +x, +y, +z, -x, -y, -z: means over the
/// directions nearest to each axis.
using AxisDepths = std::array<float, 6>;

/// How much hair lies around each point, for strands of diameter `width` from root to tip; strand s
/// has the points [strand_begin[s], strand_begin[s + 1]). From a grid of the strands' area, about
/// 100 cells along the longest side, looked through in 14 directions with steps that grow with
/// distance. Roots that stand all over something round are taken for its skin, which nothing
/// passes.
std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> strand_begin, float width);

/// The same around the points of anything that stops light, `pieces`; each card begins at its root.
std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> card_begin,
                                       const AmbientPieces& pieces);

/// As the shader reads them: six bytes (ambient_code of hair/environment/ambient.glsl) in two
/// words.
std::vector<glm::uvec2> pack_ambient_depths(const std::vector<AxisDepths>& depths);

}  // namespace vellus::hair
