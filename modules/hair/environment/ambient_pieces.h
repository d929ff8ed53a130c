#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace vellus::hair {

struct CardGroom;

/// Strands of a groom in pieces that are small beside it: where they are and where they point, as
/// long as their area (length times width, square metres).
struct AmbientPieces {
    std::vector<glm::vec3> at;
    std::vector<glm::vec3> strands;
};

/// The strands that cards show: pieces of triangles, whose strands lie anywhere in them and
/// together cover what the atlas says. Strands of a card lie along it.
AmbientPieces card_pieces(const CardGroom& cards);

}  // namespace vellus::hair
