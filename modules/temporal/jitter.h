#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace vellus::temporal {

/// Van der Corput's radical inverse of `index` in `base` >= 2, in [0, 1).
inline double radical_inverse(uint32_t index, uint32_t base) {
    double result = 0.0;
    double digit = 1.0;
    for (; index > 0; index /= base) {
        digit /= base;
        result += digit * (index % base);
    }
    return result;
}

/// Sub-pixel offset of the camera for a frame, in pixels, (-½, ½): Halton (2, 3), 16 frames long.
inline glm::vec2 halton_jitter(uint32_t frame) {
    const uint32_t index = frame % 16 + 1;
    return {static_cast<float>(radical_inverse(index, 2) - 0.5),
            static_cast<float>(radical_inverse(index, 3) - 0.5)};
}

}  // namespace vellus::temporal
