#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::sculpt {

/// One file of the project's own assets; `path` is relative to assets/.
struct AssetFile {
    std::string path;
    std::vector<std::byte> bytes;
};

/// Every file the generator makes: always the same bytes. Takes some ten seconds of CPU time.
Result<std::vector<AssetFile>> make_asset_files();

}  // namespace vellus::sculpt
