#pragma once

#include <string>
#include <vector>

#include "tests/perf/report/report.h"

namespace vellus::bench {

struct SceneOptions {
    std::vector<std::string> scenes;  ///< names below assets/scenes, or files; none: all
    std::vector<uint32_t> size{640, 360};
    uint32_t frames = 64;
    uint32_t warm_up = 8;
    std::string device;
    std::string csv;         ///< folder for a line per frame; empty: none
    double inject_ms = 0.0;  ///< wasted in every frame
};

/// Draws the demo's scenes, prints what their frames and passes took and adds the rows, the
/// pictures' hashes and the device's name.
Result<void> measure_scenes(const SceneOptions& options, Report& report,
                            std::vector<double>& calibrations);

}  // namespace vellus::bench
