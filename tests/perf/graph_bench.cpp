#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "engine/frame_graph/compile.h"
#include "tests/perf/allocation_count.h"
#include "tests/perf/bench.h"
#include "tests/perf/graph_frames.h"

namespace vellus::bench {

namespace {

using graph::Compiler;
using graph::Diagnostics;
using graph::GraphDescription;
using graph::Plan;

struct Timing {
    double describe_us = 0;
    double total_us = 0;
    uint64_t allocations = 0;
    bool correct = true;
};

double us(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double, std::micro>(time).count();
}

Timing measure(GraphShape shape, uint32_t passes) {
    GraphDescription graph;
    Compiler compiler;
    Plan plan;
    Diagnostics diagnostics;
    Timing best{.describe_us = 1e9, .total_us = 1e9};
    const uint32_t repeats = std::max(200'000U / passes, 100U);
    for (uint32_t i = 0; i < repeats; ++i) {
        const uint64_t allocations_before = allocations();
        const auto start = std::chrono::steady_clock::now();
        describe_frame(graph, shape, passes);
        const auto described = std::chrono::steady_clock::now();
        const bool compiled = compiler.compile(graph, {}, plan, diagnostics);
        const auto end = std::chrono::steady_clock::now();
        best.describe_us = std::min(best.describe_us, us(described - start));
        best.total_us = std::min(best.total_us, us(end - start));
        if (i > 0) best.allocations += allocations() - allocations_before;
        best.correct = best.correct && compiled && plan.steps.size() == passes &&
                       plan.transient_bytes <= kMostTransientBytes;
    }
    return best;
}

int run() {
    fmt::print("frame graph: describe and compile, best of many frames\n");
    fmt::print("{:>6} {:>7} {:>12} {:>12} {:>12} {:>9} {:>26}\n", "shape", "passes", "describe us",
               "compile us", "total us", "ns/pass", "allocations, steady frames");
    bool correct = true;
    for (const GraphShape shape : {GraphShape::kChain, GraphShape::kBusy}) {
        for (const uint32_t passes : {10U, 100U, 1000U, 10000U}) {
            const Timing t = measure(shape, passes);
            fmt::print("{:>6} {:>7} {:>12.2f} {:>12.2f} {:>12.2f} {:>9.1f} {:>26}\n",
                       name_of(shape), passes, t.describe_us, t.total_us - t.describe_us,
                       t.total_us, t.total_us * 1000 / passes, t.allocations);
            correct = correct && t.correct && t.allocations == 0;
        }
    }
    fmt::print("targets: 100 passes 10 us, 10000 passes 1000 us, no allocation\n");
    if (!correct) fmt::print("wrong plan, or memory was allocated\n");
    return correct ? 0 : 1;
}

const Registration kGraph({"graph", "Frame graph: set-up and compile by number of passes",
                           [](CLI::App&) { return run; }});

}  // namespace

}  // namespace vellus::bench
