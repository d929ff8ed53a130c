#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/hair/groom/groom.h"

namespace vellus::hair {

/// What a groom holds after load, and what was wrong with it. Lengths are in the file's unit.
struct GroomReport {
    uint64_t strands = 0;
    uint64_t points = 0;
    uint64_t segments = 0;
    uint32_t min_points = 0;
    uint32_t max_points = 0;
    double min_length = 0.0;
    double mean_length = 0.0;
    double max_length = 0.0;
    Bounds bounds;

    /// Segments of length zero: kept in the columns, skipped when segments are prepared.
    uint64_t zero_segments = 0;
    /// Segments shorter than 1e-5 of the file's unit, zero ones not counted: kept and drawn.
    uint64_t tiny_segments = 0;
    /// Neighbouring segments that turn by 180 degrees: kept, tangents stay bounded.
    uint64_t folds = 0;
    /// Strands with fewer than two points: dropped.
    uint64_t short_strands = 0;
    /// Strands with a coordinate that is NaN, infinite or beyond 1e9: dropped.
    uint64_t non_finite_strands = 0;
    /// Strands whose points all coincide: dropped, nothing of them can be drawn.
    uint64_t collapsed_strands = 0;
    /// Thickness, transparency, colour or UV values that were NaN, infinite or out of range:
    /// clamped.
    uint64_t clamped_attributes = 0;
    /// What the reader had to decide, one line each.
    std::vector<std::string> notes;

    [[nodiscard]] bool clean() const {
        return zero_segments + tiny_segments + folds + short_strands + non_finite_strands +
                   collapsed_strands + clamped_attributes ==
               0;
    }
};

/// Drops and clamps what cannot be drawn, in place, and says what it did.
GroomReport repair(Groom& groom);

/// A few lines for people: counts, lengths, box, then one line per kind of defect and its remedy.
std::string to_text(const GroomReport& report);

}  // namespace vellus::hair
