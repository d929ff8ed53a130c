#pragma once

#include <functional>

#include "engine/platform/result.h"
#include "modules/hair/groom/groom.h"
#include "modules/hair/grow/settings.h"
#include "modules/hair/grow/surface.h"

namespace vellus::hair {

/// Told now and then how far growing is, 0 to 1.
using GrowProgress = std::function<void(float share)>;

/// Grows hair on the haired part of `surface`, in its space (metres, Y up): roots spread evenly
/// over the skin, guides traced over the body, strands interpolated between guides. The first n
/// strands of a groom are spread evenly for every n. Same surface, settings and seed: the same
/// bits. An Error names a setting out of range, or says that nothing is haired.
///
///     auto groom = grow_groom(sphere_surface({0, 1.6f, 0}, 0.1f, false),
///                             preset(GrowStyle::kBob), 7);
Result<Groom> grow_groom(const GrowSurface& surface, const GrowSettings& settings, uint32_t seed,
                         const GrowProgress& progress = {});

}  // namespace vellus::hair
