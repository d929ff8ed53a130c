#pragma once

#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// Position at a fraction of the strand's length, 0 at the root to 1 at the tip.
glm::vec3 strand_position(const StrandData& strands, size_t strand, float fraction);

/// Diameter in metres at a point; `tip_scale` as in HairWidth.
float strand_width(const StrandData& strands, size_t point, float tip_scale);

}  // namespace vellus::hair
