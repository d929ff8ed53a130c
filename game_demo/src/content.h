#pragma once

#include <filesystem>

#include "game_demo/src/content_host.h"
#include "game_demo/src/options.h"

namespace vellus::demo {

/// What a file did not bring.
struct LoadedContent {
    bool default_sky = false;  ///< no environment of its own: the default sky is around it
};

/// Fills the world from a glTF scene or a groom file; a default sky, sun and camera stand in for
/// what the file lacks. The camera it is drawn from is the one with scene::ActiveCamera.
Result<LoadedContent> load_content(ContentHost& host, const Options& options);

/// The file that is opened: the default scene where none was given.
std::filesystem::path content_path(const Options& options);
/// Where the scenes are that come with the program.
std::filesystem::path scene_folder();

}  // namespace vellus::demo
