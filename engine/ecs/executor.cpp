#include "engine/ecs/executor.h"

#include "engine/ecs/contract.h"

namespace vellus {

Executor::Executor(const std::vector<System*>& systems, const ScheduleGraph& graph,
                   const ScheduleOrder& order)
    : waiting_for_(std::make_unique<std::atomic<uint32_t>[]>(systems.size())) {
    for (System* system : systems) nodes_.push_back({system, 0, {}});
    for (const uint32_t from : order.order) {
        for (const uint32_t to : graph.successors[from]) {
            if (order.phases[from] != order.phases[to]) continue;
            nodes_[from].successors.push_back(to);
            ++nodes_[to].predecessors;
        }
    }
    for (const uint32_t node : order.order) {
        if (phases_.size() <= order.phases[node]) phases_.resize(order.phases[node] + 1);
        Phase& phase = phases_[order.phases[node]];
        phase.nodes.push_back(node);
        if (nodes_[node].predecessors == 0) phase.roots.push_back(node);
        phase.exclusive = graph.accesses[node].exclusive;
    }
}

void Executor::run(World& world) {
    for (const Phase& phase : phases_) {
        if (phase.exclusive) {
            run_phase(phase);
        } else {
            const World::Lock lock(world);
            run_phase(phase);
        }
        for (const uint32_t node : phase.nodes) nodes_[node].system->commands.apply(world);
    }
}

void Executor::run_phase(const Phase& phase) {
    if (phase.nodes.size() == 1) {
        nodes_[phase.nodes[0]].system->run();
        return;
    }
    for (const uint32_t node : phase.nodes) {
        waiting_for_[node].store(nodes_[node].predecessors, std::memory_order_release);
    }
    unfinished_.store(phase.nodes.size(), std::memory_order_relaxed);
    for (size_t i = 1; i < phase.roots.size(); ++i) spawn(phase.roots[i]);
    run_node(phase.roots[0]);
    tasks_.wait();
    const size_t unfinished = unfinished_.load(std::memory_order_acquire);
    if (unfinished != 0) contract_failed("ecs: a phase ended before its systems did");
}

/// oneTBB orders what a task does after what came before `run`, and before what follows `wait`. The
/// acquires and releases here say so again in our own code, where ThreadSanitizer sees it: Debian's
/// libtbb is not instrumented.
void Executor::spawn(uint32_t node) {
    tasks_.run([this, node, ready = &waiting_for_[node]] {
        static_cast<void>(ready->load(std::memory_order_acquire));
        run_node(node);
    });
}

/// Runs the system, goes on with one successor that became ready, and leaves others to other cores.
void Executor::run_node(uint32_t node) {
    constexpr uint32_t kNone = UINT32_MAX;
    while (node != kNone) {
        nodes_[node].system->run();
        uint32_t next = kNone;
        for (const uint32_t successor : nodes_[node].successors) {
            if (waiting_for_[successor].fetch_sub(1, std::memory_order_acq_rel) != 1) continue;
            if (next != kNone) spawn(successor);
            if (next == kNone) next = successor;
        }
        unfinished_.fetch_sub(1, std::memory_order_release);
        node = next;
    }
}

}  // namespace vellus
