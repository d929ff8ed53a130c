#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "modules/hair/groom/strand_area.h"

namespace vellus::hair {

struct CardGroom;

/// Strands of a groom in pieces that are small beside it, in square metres.
struct AmbientPieces {
    std::vector<glm::vec3> at;
    std::vector<StrandArea> strands;
};

/// The strands that cards show: pieces of triangles, whose strands lie anywhere in them and
/// together cover what the atlas says. Strands of a ribbon point where its rows say
/// (row_directions.h), those of other cards along them.
AmbientPieces card_pieces(const CardGroom& cards);

}  // namespace vellus::hair
