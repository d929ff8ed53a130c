#include "tests/unit/frame_graph/random_graph.h"

#include <gtest/gtest.h>

#include "tests/unit/frame_graph/simulator.h"

namespace vellus::graph::test {
namespace {

// Every plan of some thousand random frames, under random switches, survives the simulator.
TEST(RandomGraphs, PlansAreCorrect) {
    Compiler compiler;
    GraphDescription graph;
    Plan plan;
    Diagnostics diagnostics;
    uint32_t planned = 0;
    uint64_t aliased = 0;
    for (uint64_t seed = 0; seed < 6000; ++seed) {
        Choices choices({}, seed);
        graph.reset();
        random_graph(choices, false, graph);
        CompileOptions options{.switches = random_switches(choices)};
        if (!compiler.compile(graph, options, plan, diagnostics)) {
            ASSERT_FALSE(diagnostics.empty()) << "seed " << seed;
            continue;
        }
        ++planned;
        aliased += plan.transient_bytes < plan.transient_unaliased_bytes;
        ASSERT_EQ(simulate(graph, options, plan), "") << "seed " << seed << "\n"
                                                      << explain(graph, plan);
    }
    EXPECT_GT(planned, 4000U);  // the generator makes legal frames
    EXPECT_GT(aliased, 1000U);  // and they share memory
}

// The referee is awake: it notices each barrier that is taken away, so none is superfluous.
TEST(RandomGraphs, SimulatorSeesAMissingBarrier) {
    Compiler compiler;
    GraphDescription graph;
    Plan plan;
    Diagnostics diagnostics;
    uint32_t tried = 0;
    for (uint64_t seed = 0; seed < 400; ++seed) {
        Choices choices({}, seed);
        graph.reset();
        random_graph(choices, false, graph);
        // Barriers for aliasing are for all memory and often make others superfluous.
        const CompileOptions options{.switches = {.no_aliasing = true}};
        if (!compiler.compile(graph, options, plan, diagnostics)) continue;
        for (Barrier& barrier : plan.barriers) {
            // Execution alone may be ordered by its neighbours in the batch.
            const bool transition = barrier.old_layout != barrier.new_layout;
            if (barrier.reason == Reason::kWriteAfterRead && !transition) continue;
            const Barrier kept = barrier;
            barrier.src_stages = barrier.dst_stages = 0;
            barrier.new_layout = barrier.old_layout;
            ++tried;
            EXPECT_NE(simulate(graph, options, plan), "")
                << "seed " << seed << ": " << explain(graph, plan, kept);
            barrier = kept;
        }
    }
    EXPECT_GT(tried, 1000U);
}

// Broken frames end in diagnostics that can be printed, or in a plan that is right all the same.
TEST(RandomGraphs, MistakesAreRefused) {
    Compiler compiler;
    GraphDescription graph;
    Plan plan;
    Diagnostics diagnostics;
    uint32_t refused = 0;
    for (uint64_t seed = 0; seed < 3000; ++seed) {
        Choices choices({}, seed);
        graph.reset();
        random_graph(choices, true, graph);
        CompileOptions options{.switches = random_switches(choices)};
        if (compiler.compile(graph, options, plan, diagnostics)) {
            ASSERT_EQ(simulate(graph, options, plan), "") << "seed " << seed;
            continue;
        }
        ++refused;
        for (const Diagnostic& diagnostic : diagnostics) {
            ASSERT_NE(describe(graph, diagnostic).find(".cpp:"), std::string::npos);
        }
    }
    EXPECT_GT(refused, 1000U);
}

}  // namespace
}  // namespace vellus::graph::test
