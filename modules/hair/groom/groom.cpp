#include "modules/hair/groom/groom.h"

#include <cmath>

namespace vellus::hair {

namespace {

// IEC 61966-2-1.
float srgb_to_linear(float value) {
    if (value <= 0.04045f) return value / 12.92f;
    return std::pow((value + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 to_linear(const Groom& groom, glm::vec3 color) {
    if (groom.format == GroomFormat::kGltf) return color;
    return {srgb_to_linear(color.r), srgb_to_linear(color.g), srgb_to_linear(color.b)};
}

}  // namespace

float thickness_at(const Groom& groom, size_t strand, size_t point) {
    if (groom.thickness.empty()) return groom.default_thickness;
    return groom.thickness[groom.thickness.size() == groom.points.size() ? point : strand];
}

float transparency_at(const Groom& groom, size_t point) {
    if (!groom.transparency.empty()) return groom.transparency[point];
    if (!groom.colors.empty() && groom.colors[point].a != 1.0f) return 1.0f - groom.colors[point].a;
    return groom.default_transparency;
}

glm::vec4 color_at(const Groom& groom, size_t point) {
    const glm::vec3 constant = groom.has_default_color ? groom.default_color : glm::vec3(1.0f);
    const glm::vec4 color = groom.colors.empty() ? glm::vec4(constant, 1.0f) : groom.colors[point];
    if (groom.transparency.empty()) return color;
    return {glm::vec3(color), 1.0f - groom.transparency[point]};
}

glm::vec4 linear_color_at(const Groom& groom, size_t point) {
    const glm::vec4 color = color_at(groom, point);
    return {to_linear(groom, glm::vec3(color)), color.a};
}

glm::vec3 linear_default_color(const Groom& groom) {
    return to_linear(groom, groom.has_default_color ? groom.default_color : glm::vec3(1.0f));
}

bool has_colors(const Groom& groom) {
    return !groom.colors.empty() || groom.has_default_color;
}

Bounds bounds_of(const Groom& groom) {
    Bounds bounds;
    for (const glm::vec3& point : groom.points) bounds.add(point);
    return bounds;
}

}  // namespace vellus::hair
