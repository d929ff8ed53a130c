#pragma once

#include <span>

#include "modules/hair/cards/ribbon.h"

namespace vellus::hair {

/// Turns ribbons over whose front faces the rest of the hair: away from it lies what is seen most,
/// and an atlas holds the front only. The rest pulls like gravity: nothing inside a shell of hair,
/// inwards at it.
void face_outwards(std::span<Ribbon> ribbons);

}  // namespace vellus::hair
