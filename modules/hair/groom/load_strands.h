#pragma once

#include <filesystem>
#include <string>

#include "engine/platform/result.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// A groom file's strands in node space and metres, not yet on any device.
struct LoadedStrands {
    std::string name;  ///< the same for the same file and `upright`
    StrandData strands;
    GroomReport report;
};

/// Name that load_strands() gives, without reading the file.
std::string strands_name(const std::filesystem::path& path, bool upright);

/// Reads a groom and logs its report. `upright`: turn it upright and into metres
/// (groom/upright.h).
Result<LoadedStrands> load_strands(const std::filesystem::path& path, bool upright);

}  // namespace vellus::hair
