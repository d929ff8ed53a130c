#pragma once

#include <optional>
#include <vector>

#include "modules/hair/grow/closest.h"
#include "modules/hair/grow/gather.h"
#include "modules/hair/grow/head.h"

namespace vellus::hair::grow {

using Line = std::vector<glm::dvec3>;

/// What hair grows on: the body, and the head that styles are drawn around.
struct Ground {
    const ClosestPoint& body;
    Head head;
    const GrowSettings& settings;
    uint32_t seed = 0;
};

/// A traced hair without clumps, curl or frizz. `line` has kGuidePoints points, evenly spaced;
/// where hair is gathered it ends at the band.
struct Guide {
    Line line;
    double length = 0.0;
    double from_parting = 0.0;
    /// How far this hair stays off the skin once it has left its root, in metres.
    double layer = 0.0;
};

constexpr size_t kGuidePoints = 40;

/// Traces a hair from `root` over the body.
Guide trace_guide(const Ground& ground, const Root& root, uint32_t key,
                  const std::optional<Gather>& gather);

/// `count` points evenly spaced along a line by arc length.
Line resample(const Line& line, size_t count);
/// Metres from end to end.
double length_of(const Line& line);

}  // namespace vellus::hair::grow
