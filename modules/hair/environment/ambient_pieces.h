#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace vellus::hair {

struct CardGroom;

/// What of a groom stops light, in pieces that are small beside it: where, and how large each is
/// seen along x, y and z, in square metres.
struct AmbientPieces {
    std::vector<glm::vec3> at;
    std::vector<glm::vec3> area;
};

/// The strands that cards show: pieces of triangles, whose strands lie anywhere in them and
/// together cover what the atlas says. Strands of a card lie along it.
AmbientPieces card_pieces(const CardGroom& cards);

}  // namespace vellus::hair
