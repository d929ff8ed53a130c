#pragma once

#include "assets/generator/gltf_scene.h"

namespace vellus::sculpt {

/// A fox on a lawn, its fur bound to its skin: grooms/fox.hair, in the encoding of to_groom().
GltfScene make_fur_scene(const std::vector<SkinnedPart>& fox);

}  // namespace vellus::sculpt
