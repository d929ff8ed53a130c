#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/frame_graph/execute.h"
#include "tests/perf/report/report.h"

namespace vellus::bench {

/// Counted frames as columns, in milliseconds.
struct FrameSamples {
    std::vector<double> wall_ms;
    std::vector<double> cpu_ms;
    std::vector<double> gpu_ms;
    std::vector<std::pair<std::string, std::vector<double>>> passes;
    double bytes = 0.0;  ///< on the device in the last frame

    /// A pass described more than once counts with its sum.
    void add(double wall, double cpu, const graph::FrameReport& frame);
};

/// NAME/wall, NAME/cpu, NAME/PASS of every pass and NAME/memory.
void add_rows(Report& report, const std::string& name, const FrameSamples& samples);

/// The passes that take at least `least_ms`, the longest first, a line each.
void print_passes(const FrameSamples& samples, double least_ms);

/// One line: what the calibration took, and on which device.
void print_calibration(const Report& report);

}  // namespace vellus::bench
