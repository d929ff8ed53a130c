#pragma once

#include <glm/glm.hpp>

namespace vellus::scene {

/// A rectangle of pixels, `end` not included.
struct PixelRect {
    glm::ivec2 first{0};
    glm::ivec2 end{0};

    [[nodiscard]] bool empty() const { return end.x <= first.x || end.y <= first.y; }
};

/// The smallest around both.
inline PixelRect around(const PixelRect& a, const PixelRect& b) {
    if (a.empty() || b.empty()) return a.empty() ? b : a;
    return {glm::min(a.first, b.first), glm::max(a.end, b.end)};
}

}  // namespace vellus::scene
