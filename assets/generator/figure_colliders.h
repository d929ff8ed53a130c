#pragma once

#include "assets/generator/gltf_scene.h"

namespace vellus::sculpt {

/// Capsules of head, neck and torso, and an upper arm's on either side with its sleeve, below the
/// joints of the figure's rig.
void add_figure_colliders(GltfScene& scene, const Rig& rig);

}  // namespace vellus::sculpt
