#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/ecs/access.h"
#include "engine/platform/result.h"

namespace vellus {

/// The pure part of a schedule: names, accesses and declared edges in, order and phases out.
struct ScheduleGraph {
    std::vector<std::string> names;
    std::vector<Access> accesses;
    std::vector<std::vector<uint32_t>> successors;  ///< Declared edges, by system.
};

/// Phases run one after another, with all Commands applied after each; within a phase systems run
/// as soon as their predecessors in it are done.
struct ScheduleOrder {
    std::vector<uint32_t> order;   ///< All systems, predecessors first; else as they were added.
    std::vector<uint32_t> phases;  ///< By system.
};

/// Errors: a cycle, naming its systems; ambiguities, naming both systems and what they touch.
Result<ScheduleOrder> order_systems(const ScheduleGraph& graph);

}  // namespace vellus
