#pragma once

#include <string>
#include <vector>

#include "tests/perf/report/report.h"

namespace vellus::bench {

struct EngineOptions {
    std::string only;  ///< rows whose name has this; empty: all
    uint32_t rounds = 24;
    double inject_ms = 0.0;   ///< wasted in every round
    std::string inject_into;  ///< of rows whose name has this
};

/// Measures what the engine does without a device, prints a line each and adds the rows; the
/// calibration takes turns with the rounds. An Error names the case that failed or whose result is
/// wrong.
Result<void> measure_engine(const EngineOptions& options, Report& report,
                            std::vector<double>& calibrations);

}  // namespace vellus::bench
