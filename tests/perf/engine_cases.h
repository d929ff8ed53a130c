#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/platform/result.h"
#include "tests/perf/timed_work.h"

namespace vellus::bench {

/// Something the engine does without a device, over and over.
struct EngineCase {
    std::function<Timed()> round;
    /// What a round leaves in memory, if that is worth a row of its own.
    std::function<double()> bytes;
};

/// Makes a case when its turn comes, so that only one case's data are in memory.
struct EngineCaseMaker {
    std::string name;  ///< AREA/WHAT, its row in the report
    std::function<Result<EngineCase>()> make;
};

/// Entities visited, made, changed and destroyed: the Vellus side of `vellus_bench ecs --quick`.
std::vector<EngineCaseMaker> entity_cases();
/// Frames described and compiled, 10,000 passes a round.
std::vector<EngineCaseMaker> frame_graph_cases();
/// Scenes, grooms and pictures from files to columns.
std::vector<EngineCaseMaker> asset_cases();
/// Grooms grown, sorted and bound.
std::vector<EngineCaseMaker> groom_cases();

}  // namespace vellus::bench
