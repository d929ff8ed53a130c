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

/// How many channel values a reader had to repair (see load_image_f).
struct PixelRepairs {
    uint64_t not_finite = 0;
    uint64_t negative = 0;
};

/// Linear RGBA floats, row by row from the top left.
struct ImageF {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> rgba;
    PixelRepairs repairs;
};

}  // namespace vellus::asset
