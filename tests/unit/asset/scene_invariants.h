#pragma once

#include <string>

#include "engine/asset/scene_asset.h"

namespace vellus::asset::test {

/// What scene_asset.h and gltf.h promise of every loaded scene: indices in range, lengths that
/// agree, a forest of nodes, finite numbers, unit normals and rotations. Empty where all holds,
/// else the first thing that does not.
std::string broken_promise(const SceneAsset& scene);

}  // namespace vellus::asset::test
