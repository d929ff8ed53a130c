#include "modules/hair/cards/card_groom.h"

#include <array>
#include <glm/gtc/color_space.hpp>

namespace vellus::hair {

namespace {

template <class T>
uint64_t column_bytes(const std::vector<T>& column) {
    return column.size() * sizeof(T);
}

}  // namespace

uint64_t CardGroom::bytes() const {
    return column_bytes(points) + column_bytes(uvs) + column_bytes(triangles) +
           column_bytes(card_begin) + column_bytes(parameters) + column_bytes(frames) +
           column_bytes(atlas.opacity) + column_bytes(atlas.depth) + column_bytes(atlas.parameter) +
           column_bytes(atlas.tangent) + column_bytes(atlas.strand) + column_bytes(atlas.fibres) +
           column_bytes(atlas.color);
}

Bounds bounds_of(const CardGroom& cards) {
    Bounds box;
    const auto reach = glm::vec3(cards.depth_range);
    for (size_t i = 0; i < cards.points.size(); ++i) {
        box.add(cards.points[i] - reach);
        box.add(cards.points[i] + reach);
        if (!cards.ribbons || i % 3 != 2) continue;
        // A ribbon's tube may turn any of its two half axes to any side.
        const glm::vec3 middle = 0.5f * (cards.points[i - 2] + cards.points[i - 1]);
        const float radius = glm::max(glm::distance(middle, cards.points[i]),
                                      glm::distance(middle, cards.points[i - 1]));
        box.add(middle - glm::vec3(radius));
        box.add(middle + glm::vec3(radius));
    }
    return box;
}

std::optional<glm::vec3> mean_color(const CardGroom& cards) {
    if (cards.atlas.color.empty()) return cards.color;
    std::array<double, 256> linear{};
    for (size_t i = 0; i < linear.size(); ++i) {
        linear[i] = glm::convertSRGBToLinear(glm::dvec3(static_cast<double>(i) / 255.0)).x;
    }
    glm::dvec3 sum(0.0);
    double opacity = 0.0;
    for (size_t i = 0; i < cards.atlas.texels(); ++i) {
        const auto weight = static_cast<double>(cards.atlas.opacity[i]);
        if (weight == 0.0) continue;
        const glm::u8vec3 color = cards.atlas.color[i];
        sum += weight * glm::dvec3(linear[color.x], linear[color.y], linear[color.z]);
        opacity += weight;
    }
    if (opacity == 0.0) return std::nullopt;
    return cards.color.value_or(glm::vec3(1.0f)) * glm::vec3(sum / opacity);
}

}  // namespace vellus::hair
