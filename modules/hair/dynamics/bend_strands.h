#pragma once

#include <span>

#include "modules/hair/dynamics/groom_motion.h"

namespace vellus::hair {

/// Bends strands, which their roots have carried to `points` (world, metres), as their guides are
/// bent: shaders/hair/dynamics/move.comp.glsl for worlds without a device. Strand s has the points
/// [strand_begin[s], strand_begin[s + 1]); `parameters` are StrandData's.
void bend_strands(const GroomMotion& groom, std::span<const uint32_t> strand_begin,
                  std::span<const uint16_t> parameters, std::span<glm::dvec3> points);

}  // namespace vellus::hair
