#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/asset/scene_asset.h"

namespace vellus::character::reference {

struct SkinnedVertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;  ///< unit; (0, 0, 1) where the input gives no direction
};

/// Morphing, then linear blend skinning, one vertex at a time in double, straight from glTF 2.0
/// sections 3.7.2.2 and 3.7.3. `palette` maps mesh space to the space wanted; entry 0 moves
/// primitives without joints. Weights are divided by their sum.
SkinnedVertices skin(const asset::Primitive& primitive, std::span<const glm::dmat4> palette,
                     std::span<const float> morph_weights);

}  // namespace vellus::character::reference
