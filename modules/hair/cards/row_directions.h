#pragma once

#include <vector>

#include "modules/hair/cards/card_groom.h"
#include "modules/hair/groom/strand_area.h"

namespace vellus::hair {

/// Where the strands of every row of a ribbons' groom lead, in the row's frame (across, along,
/// toward) and of area 1, from its atlas: means over the texels between the neighbouring rows,
/// weighted by opacity. Rows without hair lead along the card. On the device each is the two vec3
/// of shaders/hair/cards/cards.glsl.
std::vector<StrandArea> row_directions(const CardGroom& cards);

}  // namespace vellus::hair
