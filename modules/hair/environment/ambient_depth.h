#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "modules/hair/environment/ambient_volume.h"

namespace vellus::hair {

/// What lies around a point of a groom along +x, +y, +z, -x, -y, -z: optical depth of hair, as far
/// as skin if that is there, and which share of the directions, weighted by what hair lets through,
/// no skin hides. Means over the directions nearest to each axis, mostly its own.
struct AxisDepths {
    std::array<float, 6> hair{};
    std::array<float, 6> open{};
};

/// How much hair lies around each point; strand s has the points [strand_begin[s], strand_begin[s +
/// 1]). From a grid of the strands' area, about 100 cells along the longest side, looked through in
/// 14 directions with steps that grow with distance. Roots that stand all over something round are
/// taken for its skin, which nothing passes.
std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> strand_begin,
                                       const StrandTaper& taper);

/// The same around the points of anything that stops light, `pieces`; each card begins at its root.
std::vector<AxisDepths> ambient_depths(std::span<const glm::vec3> points,
                                       std::span<const uint32_t> card_begin,
                                       const AmbientPieces& pieces);

/// The same in a volume that is there already, whose skin stays as it is.
std::vector<AxisDepths> ambient_depths(const AmbientVolume& volume,
                                       std::span<const glm::vec3> points);

/// As the shader reads them: three times ten bits (ambient_code of hair/environment/ambient.glsl)
/// in each of two words.
std::vector<glm::uvec2> pack_ambient_depths(const std::vector<AxisDepths>& depths);

}  // namespace vellus::hair
