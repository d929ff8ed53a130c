#pragma once

#include <cstdint>
#include <vector>

namespace vellus::asset {

/// Eight-bit RGBA pixels, row by row from the top left; colour is sRGB-encoded.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};

/// Linear RGBA floats, row by row from the top left.
struct ImageF {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> rgba;
};

}  // namespace vellus::asset
