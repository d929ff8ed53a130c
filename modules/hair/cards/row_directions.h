#pragma once

#include "modules/hair/cards/card_groom.h"

namespace vellus::hair {

/// Where the strands of a ribbon's row lead: second moments of their unit tangents in the row's
/// frame.
struct RowDirections {
    glm::vec3 squares{0.0f, 1.0f, 0.0f};  ///< across², along², toward²; their sum is 1
    glm::vec3 products{0.0f};             ///< across along, along toward, toward across

    /// How much of a strand's length is seen on average along a unit direction of that frame (root
    /// mean square).
    [[nodiscard]] float seen_along(glm::vec3 direction) const;
};

/// Of every row of a ribbons' groom, from its atlas: means over the texels between the neighbouring
/// rows, weighted by opacity. Rows without hair lead along the card. Mirrored on the device by
/// shaders/hair/cards/cards.glsl as pairs of vec3.
std::vector<RowDirections> row_directions(const CardGroom& cards);

}  // namespace vellus::hair
