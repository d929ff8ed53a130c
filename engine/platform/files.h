#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/platform/result.h"

namespace vellus {

/// The whole file; an Error that names it if it is missing, no regular file, or unreadable.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

/// Writes a temporary file beside `path`, then renames it: readers see all of it or none.
/// Parent folders are made as needed. On failure nothing is left behind.
Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<void> write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace vellus
