#pragma once

#include <filesystem>

#include "engine/gpu/device.h"
#include "game_demo/src/options.h"
#include "game_demo/src/renderer.h"

namespace vellus::demo {

/// Fills the world from a glTF scene or a groom file; a default sky, sun and camera stand in for
/// what the file lacks. The camera it is drawn from is the one with scene::ActiveCamera.
Result<void> load_content(Renderer& renderer, gpu::Device& device, const Options& options);

/// The file that is opened: the default scene where none was given.
std::filesystem::path content_path(const Options& options);

}  // namespace vellus::demo
