#pragma once

#include <cstdint>

namespace vellus::gpu {

/// Pixel formats the engine uses; named as in Vulkan, without the prefix.
enum class Format : uint8_t {
    kUndefined,
    kR8Unorm,
    kRgba8Unorm,
    kRgba8Srgb,
    kBgra8Unorm,
    kBgra8Srgb,
    kR16Float,
    kRg16Float,
    kRgba16Float,
    kR32Uint,
    kR32Float,
    kRg32Float,
    kRgba32Float,
    kB10Gr11Ufloat,
    kD32Float,
};

/// Bytes of one pixel.
constexpr uint32_t bytes_per_pixel(Format format) {
    switch (format) {
        case Format::kUndefined:
            return 0;
        case Format::kR8Unorm:
            return 1;
        case Format::kR16Float:
            return 2;
        case Format::kRgba8Unorm:
        case Format::kRgba8Srgb:
        case Format::kBgra8Unorm:
        case Format::kBgra8Srgb:
        case Format::kRg16Float:
        case Format::kR32Uint:
        case Format::kR32Float:
        case Format::kB10Gr11Ufloat:
        case Format::kD32Float:
            return 4;
        case Format::kRgba16Float:
        case Format::kRg32Float:
            return 8;
        case Format::kRgba32Float:
            return 16;
    }
    return 0;
}

constexpr bool is_depth(Format format) {
    return format == Format::kD32Float;
}

}  // namespace vellus::gpu
