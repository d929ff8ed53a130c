#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace vellus::sculpt {

using Strand = std::vector<glm::dvec3>;

/// Long hair with a side parting.
struct HairCut {
    /// About two thirds of them become strands.
    uint32_t directions = 22'000;
    int points = 20;
    /// Factor on the length, which is 0.3 to 0.45 m.
    double length = 1.0;
};

/// Hair on the bust's scalp, root to tip, metres.
std::vector<Strand> grow_hair(const HairCut& cut = {});

/// Eyebrows and lashes: short strands of 6 points.
std::vector<Strand> grow_brows();

}  // namespace vellus::sculpt
