#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "modules/hair/reference/probe.h"
#include "tests/support/sampling.h"

namespace vellus::test {

using hair::probe::ProbeInput;
using hair::probe::ProbeOutput;
using Generator = std::function<ProbeInput(Random&)>;

/// Anything inside the functions' domain: unit directions, parameters in their ranges.
ProbeInput ordinary_input(Random& random);

/// Each field from a list of its extremes: directions at, beside and a rounding error beyond the
/// axis, zero tangents, black and white, roughness 0, depths of 1e30, NaN and infinity as history.
ProbeInput extreme_input(Random& random);

/// A direction whose sine with the unit `axis` is `sine` (clamped to ±1).
glm::vec3 inclined(Random& random, const glm::vec3& axis, double sine);

std::string describe(const ProbeInput& input);

/// Number of output values that are not finite or negative, over `count` inputs.
void expect_finite(const std::string& area, const std::string& test, const Generator& generator,
                   size_t count = 400'000);

/// Largest change of a shading value, relative to the value + 0.05, when one input moves by one
/// ulp.
void expect_continuous(const std::string& area, const std::string& test, const Generator& generator,
                       double bound, size_t count = 400'000);

}  // namespace vellus::test
