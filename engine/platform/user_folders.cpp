#include "engine/platform/user_folders.h"

#include <cstdlib>

namespace vellus {

std::filesystem::path cache_folder() {
    // The XDG rules say to ignore paths that are not absolute.
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && cache[0] == '/') {
        return std::filesystem::path(cache) / "vellus";
    }
    if (const char* home = std::getenv("HOME"); home && home[0] == '/') {
        return std::filesystem::path(home) / ".cache" / "vellus";
    }
    return {};
}

}  // namespace vellus
