#pragma once

#include <cstddef>
#include <span>

#include "engine/asset/scene_asset.h"

namespace vellus::character {

/// The last key at or before `time`, by bisection; 0 before the first one.
size_t find_key(std::span<const float> times, double time);

/// Writes the channel's value at `time` seconds to out[0, width): glTF 2.0 section 3.11 and
/// appendix C. Before the first and after the last key their values hold. Rotations are slerped
/// along the shorter arc and come out with unit length, as x, y, z, w. A channel without keys
/// writes nothing.
void sample(const asset::AnimationChannel& channel, double time, std::span<float> out);

/// Where in [0, duration] a clip is `seconds` after its start: wrapped if `loop`, else clamped.
double clip_time(double seconds, double duration, bool loop);

}  // namespace vellus::character
