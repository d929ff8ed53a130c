#pragma once

#include "modules/hair/grow/head.h"

namespace vellus::hair::grow {

/// The surface with roots closer together where hair falls to two sides, along the parting and
/// around the crown: only there no hair from further up covers the skin. The density elsewhere is
/// a third of that.
GrowSurface fuller_where_hair_parts(const GrowSurface& surface, const Head& head,
                                    const GrowSettings& settings);

}  // namespace vellus::hair::grow
