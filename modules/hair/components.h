#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/hair/cards/card_buffers.h"
#include "modules/hair/environment/ambient_volume.h"
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

/// Beside Hair: how many of its strands are drawn; without it all are. Those left are wider, so
/// that together they cover the same.
struct HairDetail {
    /// Share of the strands, down to 0.04; 0: by the groom's size on the screen.
    float share = 0.0f;
};

/// One groom as loaded: its strands on the device and what its file said.
struct LibraryGroom {
    std::string name;
    StrandBuffers strands;
    CardBuffers cards;  ///< of a groom of cards; its points are those of `strands`
    /// Points and first points of strands as on the device, for binding and dynamics.
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> strand_begin;
    /// Of cards: CardGroom::parameters.
    std::vector<uint16_t> card_parameters;
    /// Of cards: what their ambient depths are made of, until they are.
    std::shared_ptr<const CardGroom> card_source;
    /// Its density, from when it is first drawn with ambient depths until meshes below it know.
    std::shared_ptr<const AmbientVolume> volume;
    /// See StrandData::levels.
    std::vector<StrandLevel> levels;
    /// Length of all strands over the area they are seen on from the side, 1/metres: layers of hair
    /// to a pixel one metre wide.
    float layers = 0.0f;
    Bounds bounds;  ///< node space, metres
    /// Its outermost points in many directions: what a camera must see to see all of it.
    std::vector<glm::vec3> outermost;
    float width = 0.0f;
    bool has_width_column = false;
    bool has_colors = false;
    /// Colour of the whole groom where its file gives one; of cards it may multiply their atlas's.
    std::optional<glm::vec3> color;
    /// Of its column of colours, or the same as `color`.
    std::optional<glm::vec3> mean_color;
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
