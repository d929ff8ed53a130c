#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::asset {

/// One channel of a picture, row by row from the top left.
struct Plane {
    std::string name;
    std::vector<float> values;
};

/// A picture of any channels, such as radiance with its error.
struct PlaneImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<Plane> planes;

    /// Null where there is none of that name.
    [[nodiscard]] const Plane* find(const std::string& name) const;
};

/// OpenEXR of 32-bit floats, ZIP compressed; atomic, and the same bytes for the same values. Errors
/// name the file.
Result<void> save_planes(const std::filesystem::path& path, const PlaneImage& image);

/// All full-size channels of an OpenEXR file as they are, in the order of their names: half and
/// float, infinities and NaN included.
Result<PlaneImage> load_planes(const std::filesystem::path& path);

}  // namespace vellus::asset
