#pragma once

#include <string>
#include <vector>

#include "tests/perf/report/report.h"

namespace vellus::bench {

enum class Change : uint8_t { kSame, kBetter, kWorse, kNew, kGone };

/// One row of two reports. `ratio` is after / before, times divided by their run's calibration;
/// beyond 1 +- `tolerance` it is a change.
struct Comparison {
    std::string name;
    std::string unit;
    double before = 0.0;
    double after = 0.0;
    double ratio = 1.0;
    double tolerance = 0.0;
    Change change = Change::kSame;
};

/// All rows of both. A time may differ by `least` (a share) or by three times the noise that both
/// rows and both calibrations measured, whichever is more; bytes and counts by half a percent.
/// Rows below `least_ms` in both are never a change: a timer's grain is no news.
struct Tolerances {
    double least = 0.05;
    double least_ms = 0.2;
};
std::vector<Comparison> compare(const Report& before, const Report& after,
                                const Tolerances& tolerances = {});

/// Whether anything got slower or larger.
bool any_worse(const std::vector<Comparison>& comparisons);

}  // namespace vellus::bench
