#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "modules/hair/cards/card_buffers.h"
#include "modules/hair/geometry/strand_buffers.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/hair_material.h"
#include "modules/hair/techniques.h"
#include "modules/scene/bounds.h"

namespace vellus::hair {

/// Hair on an entity with a WorldTransform; drawn with its HairMaterial, HairWidth, HairShadow and
/// HairTechniques.
struct Hair {
    uint32_t groom = 0;  ///< index into the HairLibrary
};

/// How hair shadows itself and what is below it.
struct HairShadow {
    float falloff = 80.0f;  ///< extinction in 1/m behind the closest hair; about 1/mean free path
    float first = 0.002f;  ///< metres of hair that stay unshadowed, so that no strand shades itself
};

/// One groom as loaded: its strands on the device and what its file said.
struct LibraryGroom {
    std::string name;
    StrandBuffers strands;
    CardBuffers cards;  ///< of a groom of cards; its points are those of `strands`
    /// Points and first points of strands as on the device, for binding and dynamics.
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> strand_begin;
    Bounds bounds;  ///< node space, metres
    /// Its outermost points in many directions: what a camera must see to see all of it.
    std::vector<glm::vec3> outermost;
    float width = 0.0f;
    bool has_width_column = false;
    bool has_colors = false;
    /// Colour of the whole groom where its file gives one and no column of them.
    std::optional<glm::vec3> color;
    GroomReport report;
};

/// Box around the strands with their width, in node space.
inline scene::Box groom_box(const LibraryGroom& groom) {
    scene::Box box;
    if (groom.bounds.empty()) return box;
    box.include(glm::dvec3(groom.bounds.low) - static_cast<double>(groom.width));
    box.include(glm::dvec3(groom.bounds.high) + static_cast<double>(groom.width));
    return box;
}

/// All grooms of the world. Resource.
struct HairLibrary {
    std::vector<LibraryGroom> grooms;
};

}  // namespace vellus::hair
