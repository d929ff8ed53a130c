#pragma once

#include "modules/light/sky.h"

namespace vellus::light {

/// The sky at `hour` of solar time, [0, 24], on a day in early summer at 45° north; +X is east, +Z
/// is south. The sun's beam weakens with the air it crosses and is gone below the horizon, where a
/// dim blue sky stays.
Sky sky_at(double hour);

/// Sine of the sun's elevation at that hour.
double sun_elevation_sine(double hour);

}  // namespace vellus::light
