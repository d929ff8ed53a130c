#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "modules/hair/groom/groom.h"

namespace vellus::hair {

/// How much of a groom is left of it in the distance: its first strands, with their points and
/// segments.
struct StrandLevel {
    uint32_t strands = 0;
    uint32_t points = 0;
    uint32_t segments = 0;
    /// Length of all strands over that of these: drawn so much wider, they cover the same.
    float thicken = 1.0f;
};

/// A level has about 2^(-1/2) of the strands of the one before; the last about 4 %.
constexpr size_t kStrandLevels = 10;

/// A groom as the GPU wants it: packed columns in metres, Y up, in the groom's
/// node space. Points are compacted (no two neighbours of a strand coincide), so a segment always
/// joins the points first and first + 1 of one strand and has a direction. Strands stay contiguous.
/// Those of the coarsest level come first, then what each finer one adds; within that they are
/// sorted along a Morton curve through their roots: neighbours in memory are neighbours in space.
struct StrandData {
    std::vector<glm::vec3> positions;
    /// Arc length from the root over the strand's length, 0 at the root to 65535 at the tip; per
    /// point.
    std::vector<uint16_t> point_parameter;
    /// Diameter in metres per point; empty: `width` everywhere.
    std::vector<float> point_width;
    /// Linear RGB and opacity as four halves, R in the low bits; per point; empty: `color`
    /// everywhere.
    std::vector<glm::uvec2> point_color;

    /// Strand s has the points [strand_begin[s], strand_begin[s + 1]).
    std::vector<uint32_t> strand_begin;
    /// Index of the strand in the Groom; what follows is in the sorted order too.
    std::vector<uint32_t> strand_source;
    /// Random bits from the strand's index in the Groom: the same in every run.
    std::vector<uint32_t> strand_seed;
    /// Root texture coordinates; zero where the groom has none.
    std::vector<glm::vec2> strand_uv;
    /// Length in metres.
    std::vector<float> strand_length;

    /// First point of each segment, and its strand.
    std::vector<uint32_t> segment_point;
    std::vector<uint32_t> segment_strand;

    /// levels[0] is all; each level is a random subset of the one before. Shorter where a groom has
    /// too few strands.
    std::vector<StrandLevel> levels;

    float width = 0.0f;
    glm::vec4 color{1.0f};
    bool has_color = false;
    Bounds bounds;
    float max_segment_length = 0.0f;
    /// Segments left out because their ends coincide.
    uint64_t skipped_segments = 0;

    [[nodiscard]] size_t strand_count() const { return strand_source.size(); }
    [[nodiscard]] size_t segment_count() const { return segment_point.size(); }
};

/// The diameter that stands for those of a groom without one.
constexpr float kNominalWidth = 1e-4f;

/// Columns of `groom` under `to_metres` (see upright_transform), on all cores. `width` in metres is
/// for grooms without a thickness column (see default_width). Needs a repaired groom.
StrandData prepare_strands(const Groom& groom, const glm::dmat4& to_metres, float width);

}  // namespace vellus::hair
