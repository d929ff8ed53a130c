#pragma once

#include <filesystem>
#include <iosfwd>

#include "modules/hair/groom/groom_file.h"

namespace vellus::groom_tool {

/// Before any long work: whether the name says a format that can be written.
Result<void> check_target(const std::filesystem::path& path);

/// Converts to the format that the name says, writes atomically, and prints what became of it.
Result<void> save(const hair::Groom& groom, const std::filesystem::path& path, bool keep_axes,
                  std::ostream& out);

}  // namespace vellus::groom_tool
