#pragma once

#include <vector>

#include "modules/hair/groom/strand_data.h"
#include "modules/hair/reference/visibility.h"

namespace vellus::test {

/// Every segment of these strands for rays, of one width and opacity.
inline std::vector<hair::reference::RoundSegment> round_segments(const hair::StrandData& strands,
                                                                 float width, double opacity) {
    std::vector<hair::reference::RoundSegment> segments;
    for (size_t i = 0; i < strands.segment_count(); ++i) {
        const uint32_t first = strands.segment_point[i];
        segments.push_back({.a = strands.positions[first],
                            .b = strands.positions[first + 1],
                            .radius_a = width / 2,
                            .radius_b = width / 2,
                            .opacity = opacity,
                            .strand = strands.segment_strand[i]});
    }
    return segments;
}

}  // namespace vellus::test
