#include "modules/hair/cards/card_groom.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/color_space.hpp>

namespace vellus::hair {

namespace {

/// As deep_optical_depth_of() of shaders/hair/shadow/deep_opacity.glsl has it.
constexpr float kLeastOpen = 0.001f;

template <class T>
uint64_t column_bytes(const std::vector<T>& column) {
    return column.size() * sizeof(T);
}

}  // namespace

float CardAtlas::fibres_at(size_t texel) const {
    if (!fibres.empty()) return static_cast<float>(fibres[texel]) / 16.0f;
    const float open = 1.0f - static_cast<float>(opacity[texel]) / 255.0f;
    return -std::log(std::max(open, kLeastOpen));
}

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
    glm::dvec3 sum(0.0);
    double opacity = 0.0;
    for (size_t i = 0; i < cards.atlas.texels(); ++i) {
        const auto weight = static_cast<double>(cards.atlas.opacity[i]);
        if (weight == 0.0) continue;
        sum += weight * glm::convertSRGBToLinear(glm::dvec3(cards.atlas.color[i]) / 255.0);
        opacity += weight;
    }
    if (opacity == 0.0) return std::nullopt;
    return cards.color.value_or(glm::vec3(1.0f)) * glm::vec3(sum / opacity);
}

}  // namespace vellus::hair
