#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace vellus::sculpt {

using Strand = std::vector<glm::dvec3>;

/// Long hair with a side parting on the bust's scalp, root to tip, metres; 20 points a strand.
std::vector<Strand> grow_hair();

/// Eyebrows and lashes: short strands of 6 points.
std::vector<Strand> grow_brows();

}  // namespace vellus::sculpt
