#pragma once

#include "assets/generator/gltf_scene.h"
#include "assets/generator/part.h"
#include "assets/generator/walk_cycle.h"

namespace vellus::sculpt {

/// Strides in one lap of the path.
constexpr int kLapStrides = 20;
/// The gait of the lap: its path is `turn_radius` around the scene's origin.
Gait lap_gait();

/// A person walking round a path in a park, under a low sun; a camera goes along.
GltfScene make_walk_scene(const std::vector<SkinnedPart>& figure);

}  // namespace vellus::sculpt
