#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz.h"
#include "tests/unit/frame_graph/random_graph.h"
#include "tests/unit/frame_graph/simulator.h"

using namespace vellus::graph;

// The input's bytes choose a frame, with mistakes, and switches; a plan must survive the simulator.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static Compiler compiler;
    static GraphDescription graph;
    static Plan plan;
    static Diagnostics diagnostics;
    graph.reset();
    test::Choices choices({data, size});
    const bool mischief = choices.one_in(2);
    const CompileOptions options{.switches = test::random_switches(choices)};
    test::random_graph(choices, mischief, graph);
    if (!compiler.compile(graph, options, plan, diagnostics)) {
        if (diagnostics.empty() || describe(graph, diagnostics).empty()) std::abort();
        return 0;
    }
    if (const std::string error = test::simulate(graph, options, plan); !error.empty()) {
        std::fprintf(stderr, "%s\n%s", error.c_str(), explain(graph, plan).c_str());
        std::abort();
    }
    return 0;
}

namespace vellus::fuzz {

std::vector<Bytes> fuzz_seeds() {
    std::vector<Bytes> seeds;
    for (uint32_t i = 0; i < 8; ++i) {
        Bytes bytes(300);
        test::Choices choices({}, i);
        for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(choices.below(256));
        seeds.push_back(bytes);
    }
    return seeds;
}

}  // namespace vellus::fuzz
