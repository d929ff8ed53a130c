#pragma once

#include "modules/hair/cards/card_groom.h"

namespace vellus::hair {

/// Sets card_begin and parameters, and frames where the cards are no ribbons, from points, uvs and
/// triangles: a card is what triangles join, and runs from its smallest v to its largest. Points of
/// a card that is no ribbon are made to follow each other. Builder and reader both do it, so that a
/// file need not hold these columns.
void derive_columns(CardGroom& cards);

}  // namespace vellus::hair
