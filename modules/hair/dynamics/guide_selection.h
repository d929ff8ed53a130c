#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace vellus::hair {

/// Which guides a strand follows; mirrors shaders/hair/dynamics/move.comp.glsl (scalar layout).
struct StrandGuides {
    glm::uvec3 guides{0};
    glm::vec3 weights{1.0f, 0.0f, 0.0f};  ///< sum to 1
    glm::vec3 reach{1.0f};  ///< where on each guide the strand's tip is, as a share of its length
};
static_assert(sizeof(StrandGuides) == 36);

/// Strands chosen as guides, and who follows them.
struct GuideSelection {
    std::vector<uint32_t> guides;      ///< strands, as chosen
    std::vector<StrandGuides> follow;  ///< by strand
    float spread = 0.0f;  ///< metres a strand's point may be from the same point of its guides
};

/// Guides for a groom when nobody says how many: one strand in 24, 64 to 4096.
uint32_t default_guide_count(size_t strands);

/// Chooses `count` strands far from each other in root and shape (farthest-point sampling, Gonzalez
/// 1985, from the first strand: deterministic), and for each strand up to three guides near it,
/// weighted by the inverse square of their distance. Strands are points[begin[s], begin[s + 1]).
GuideSelection select_guides(std::span<const glm::vec3> points,
                             std::span<const uint32_t> strand_begin, uint32_t count);

}  // namespace vellus::hair
