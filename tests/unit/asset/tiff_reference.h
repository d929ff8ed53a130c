#pragma once

#include <filesystem>
#include <vector>

namespace vellus::asset::test {

struct TiffImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> rgb;
};

/// The one kind of TIFF the HDR references use: little-endian, three floats, deflate,
/// floating-point predictor. Empty where the file is something else.
TiffImage read_float_tiff(const std::filesystem::path& path);

}  // namespace vellus::asset::test
