#include "tests/perf/engine_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "engine/frame_graph/compile.h"
#include "tests/perf/ecs_cases.h"
#include "tests/perf/graph_frames.h"

namespace vellus::bench {

namespace {

constexpr uint32_t kPassesPerRound = 10'000;

struct Frames {
    graph::GraphDescription description;
    graph::Compiler compiler;
    graph::Plan plan;
    graph::Diagnostics diagnostics;

    Timed run(GraphShape shape, uint32_t passes) {
        bool compiled = true;
        const double seconds = seconds_of([&] {
            for (uint32_t done = 0; done < kPassesPerRound; done += passes) {
                describe_frame(description, shape, passes);
                compiled &= compiler.compile(description, {}, plan, diagnostics);
            }
        });
        return {seconds, compiled && plan.steps.size() == passes &&
                             plan.transient_bytes <= kMostTransientBytes};
    }
};

EngineCase frame_case(GraphShape shape, uint32_t passes) {
    auto frames = std::make_shared<Frames>();
    return {[=] { return frames->run(shape, passes); },
            [=] { return static_cast<double>(frames->plan.transient_bytes); }};
}

}  // namespace

std::vector<EngineCaseMaker> entity_cases() {
    std::vector<EcsCaseMaker> ecs = iteration_cases(true);
    std::ranges::move(structure_cases(true), std::back_inserter(ecs));
    std::vector<EngineCaseMaker> makers;
    makers.reserve(ecs.size());
    for (const EcsCaseMaker& one : ecs) {
        makers.push_back({"ecs/" + one.name, [make = one.make]() -> Result<EngineCase> {
                              return EngineCase{make().vellus, {}};
                          }});
    }
    return makers;
}

std::vector<EngineCaseMaker> frame_graph_cases() {
    std::vector<EngineCaseMaker> makers;
    for (const GraphShape shape : {GraphShape::kChain, GraphShape::kBusy}) {
        for (const uint32_t passes : {100U, 1000U, 10000U}) {
            makers.push_back({fmt::format("frame_graph/{} of {} passes", name_of(shape), passes),
                              [=]() -> Result<EngineCase> { return frame_case(shape, passes); }});
        }
    }
    return makers;
}

}  // namespace vellus::bench
