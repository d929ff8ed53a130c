#pragma once

#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/ecs/schedule_graph.h"
#include "engine/ecs/system.h"

namespace vellus {

/// Runs ordered systems phase by phase, those of a phase on all cores. Allocates only when made.
class Executor {
  public:
    Executor(const std::vector<System*>& systems, const ScheduleGraph& graph,
             const ScheduleOrder& order);
    void run(World& world);

  private:
    struct Node {
        System* system;
        uint32_t predecessors;  // within the phase
        std::vector<uint32_t> successors;
    };
    struct Phase {
        std::vector<uint32_t> nodes;  // in schedule order
        std::vector<uint32_t> roots;
        bool exclusive;
    };

    void run_phase(const Phase& phase);
    void run_node(uint32_t node);
    void spawn(uint32_t node);

    std::vector<Node> nodes_;
    std::vector<Phase> phases_;
    std::unique_ptr<std::atomic<uint32_t>[]> waiting_for_;  // by node, within one run
    std::atomic<size_t> unfinished_{0};                     // systems of the phase
    oneapi::tbb::task_group tasks_;
};

}  // namespace vellus
