#pragma once

#include "engine/platform/result.h"
#include "game_demo/tools/accuracy/radiance.h"

namespace vellus::demo {

/// Id of a technique on the scattering axis that shows how much of a light arrives where hair is,
/// whatever way the hair would send it. Not among those that are measured.
constexpr const char* kTransmittance = "transmittance";
/// Makes it one of the scattering axis; again does nothing.
Result<void> add_transmittance();

/// Frames of that technique with and without shadow, under one light, to what passes between the
/// light and the hair in each pixel: the shadowed frame's share of the unshadowed one's. A frame
/// that shows no hair in a pixel says nothing of it and gets the mean of those that do; `weight` of
/// pixels without any becomes 0.
void to_transmittance(const std::vector<Radiance>& unshadowed, std::vector<Radiance>& frames,
                      std::vector<float>& weight);

}  // namespace vellus::demo
