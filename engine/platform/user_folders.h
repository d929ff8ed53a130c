#pragma once

#include <filesystem>

namespace vellus {

/// Where this user's programs keep what can be made again: $XDG_CACHE_HOME/vellus, else
/// ~/.cache/vellus; empty where neither variable says. The folder may not exist yet.
std::filesystem::path cache_folder();

}  // namespace vellus
