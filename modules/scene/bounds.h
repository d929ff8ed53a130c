#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>

namespace vellus::scene {

/// Axis-aligned box in metres; empty until something is included.
struct Box {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (min + max); }
    void include(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void include(const Box& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    [[nodiscard]] std::array<glm::dvec3, 8> corners() const {
        std::array<glm::dvec3, 8> result;
        for (int i = 0; i < 8; ++i) {
            result[i] = {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                         (i & 4) != 0 ? max.z : min.z};
        }
        return result;
    }
};

/// The smallest box around an affinely transformed box (Arvo, Graphics Gems, 1990).
inline Box transform(const glm::dmat4& matrix, const Box& box) {
    if (box.empty()) return box;
    Box result{glm::dvec3(matrix[3]), glm::dvec3(matrix[3])};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 low = glm::dvec3(matrix[axis]) * box.min[axis];
        const glm::dvec3 high = glm::dvec3(matrix[axis]) * box.max[axis];
        result.min += glm::min(low, high);
        result.max += glm::max(low, high);
    }
    return result;
}

/// Around what an entity draws this frame, in world space. Component.
struct WorldBounds {
    Box box;
};

}  // namespace vellus::scene
