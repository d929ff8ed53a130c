#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>

#include "engine/asset/image.h"
#include "tests/fuzz/fuzz.h"

namespace vellus::fuzz {

/// Ends the run as a crash would.
inline void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

inline Bytes to_seed(std::span<const std::byte> bytes) {
    const auto* first = reinterpret_cast<const uint8_t*>(bytes.data());
    return {first, first + bytes.size()};
}

inline asset::Image small_image() {
    asset::Image image{5, 3, {}};
    for (int i = 0; i < 60; ++i) {
        image.rgba.push_back(static_cast<uint8_t>(i * 37));
    }
    return image;
}

inline asset::ImageF small_image_f() {
    asset::ImageF image{12, 3, {}, {}};
    for (int i = 0; i < 144; ++i) {
        image.rgba.push_back(std::ldexp(1.0f, i % 20 - 10));
    }
    return image;
}

inline bool usable(const asset::ImageF& image) {
    return image.rgba.size() == size_t{4} * image.width * image.height &&
           std::all_of(image.rgba.begin(), image.rgba.end(),
                       [](float v) { return std::isfinite(v) && v >= 0.0f; });
}

}  // namespace vellus::fuzz
