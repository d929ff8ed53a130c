#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "engine/asset/scene_asset.h"
#include "engine/platform/result.h"

namespace vellus::asset {

/// What one file may cost: everything built from it stays below `fixed_bytes` + `multiple` x its
/// bytes on disk, the files it refers to included. Decoded images count apart: `image_pixels` in
/// all, those beyond are left out.
struct GltfLimits {
    uint64_t fixed_bytes = uint64_t{256} << 20U;
    uint64_t multiple = 64;
    uint64_t image_pixels = uint64_t{1} << 29U;
    uint32_t node_depth = 512;
};

/// Reads .gltf or .glb (told apart by content) and checks all of it: what cannot be used is an
/// Error that names file and JSON pointer; what was repaired or left out is one line each in
/// SceneAsset::warnings.
Result<SceneAsset> load_gltf(const std::filesystem::path& path, const GltfLimits& limits = {});

/// The same from memory. Relative URIs are looked up in `base_dir`; where that is empty they are
/// refused.
Result<SceneAsset> load_gltf_bytes(std::span<const std::byte> bytes,
                                   const std::filesystem::path& base_dir,
                                   const GltfLimits& limits = {});

}  // namespace vellus::asset
