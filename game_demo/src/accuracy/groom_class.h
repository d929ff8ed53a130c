#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "modules/hair/groom/hair_material.h"

namespace vellus::demo {

/// Which groom and colour of an AccuracyTable come closest to a groom.
struct GroomClass {
    std::string_view groom;
    std::string_view colour;

    bool operator==(const GroomClass&) const = default;
};

/// A hair colour that is measured.
struct HairColour {
    std::string_view name;
    hair::Melanin melanin;
};
inline constexpr std::array kHairColours = {
    HairColour{"black", {8.0f, 0.0f}}, HairColour{"brown", {1.3f, 0.0f}},
    HairColour{"blond", {0.3f, 0.1f}}, HairColour{"white", {0.02f, 0.0f}}};

/// Fur by its length (shorter than 5 cm), the rest by how much shorter strands are than their arc;
/// `metres` is what a unit of the points is.
std::string_view groom_kind(std::span<const glm::vec3> points,
                            std::span<const uint32_t> strand_begin, double metres);
/// By brightness: the geometric middle between neighbours' decides.
std::string_view colour_kind(const glm::vec3& base_color);

}  // namespace vellus::demo
