#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/gpu/device.h"

namespace vellus::gpu {

/// The file of one device's cache in `folder`; drivers and their versions do not share one.
std::filesystem::path pipeline_cache_file(const std::filesystem::path& folder,
                                          VkPhysicalDevice physical);

/// What was kept in `file`; empty where there is none, and, with a warning, where it is damaged:
/// a checksum guards the drivers, which trust what they are given.
std::vector<std::byte> load_pipeline_cache(const std::filesystem::path& file);

/// Keeps `data`, atomically.
Result<void> save_pipeline_cache(const std::filesystem::path& file,
                                 std::span<const std::byte> data);

}  // namespace vellus::gpu
