#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "engine/frame_graph/compile.h"
#include "engine/frame_graph/context.h"
#include "tests/perf/allocation_count.h"
#include "tests/perf/bench.h"

namespace vellus::bench {

namespace {

using namespace graph;

constexpr ImageDesc kImage{gpu::Format::kRgba16Float, 1280, 720};

/// chain: each pass reads the image before and makes one. busy: it reads the two before and a
/// buffer too, which every fifth pass updates. Every fourth pass draws.
enum class Shape : uint8_t { kChain, kBusy };

void describe_frame(GraphDescription& graph, Shape shape, uint32_t passes) {
    graph.reset();
    const bool busy = shape == Shape::kBusy;
    ImageHandle older, newer;
    BufferHandle buffer = graph.create_buffer("buffer", {1 << 20});
    for (uint32_t i = 0; i < passes; ++i) {
        const bool raster = i % 4 == 3;
        auto pass = graph.add_pass("pass", raster ? PassKind::kRaster : PassKind::kCompute);
        const Access read = raster ? Access::kSampledFragment : Access::kSampledCompute;
        if (newer) pass.read(newer, read);
        if (older && busy) pass.read(older, read);
        if (busy && i % 5 == 0 && !raster) {
            buffer = pass.write(buffer, Access::kStorageWrite);
        } else if (busy) {
            pass.read(buffer, raster ? Access::kGraphicsStorageRead : Access::kStorageRead);
        }
        ImageHandle made = graph.create_image("image", kImage);
        made = raster ? pass.color(made, clear(0))
                      : pass.write(made, Access::kStorageWrite, {}, Load::kDiscard);
        pass.execute(
            [newer, older, buffer, made](PassContext& ctx) { static_cast<void>(ctx.view(made)); });
        older = newer;
        newer = made;
    }
    graph.output(newer);
}

struct Timing {
    double describe_us = 0;
    double total_us = 0;
    uint64_t allocations = 0;
    bool correct = true;
};

double us(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double, std::micro>(time).count();
}

Timing measure(Shape shape, uint32_t passes) {
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
        // An image lives for three passes, so four places serve them all.
        best.correct = best.correct && compiled && plan.steps.size() == passes &&
                       plan.transient_bytes <= 4 * 1280 * 720 * 8 + (1 << 20);
    }
    return best;
}

int run() {
    fmt::print("frame graph: describe and compile, best of many frames\n");
    fmt::print("{:>6} {:>7} {:>12} {:>12} {:>12} {:>9} {:>26}\n", "shape", "passes", "describe us",
               "compile us", "total us", "ns/pass", "allocations, steady frames");
    bool correct = true;
    for (const Shape shape : {Shape::kChain, Shape::kBusy}) {
        for (const uint32_t passes : {10U, 100U, 1000U, 10000U}) {
            const Timing t = measure(shape, passes);
            fmt::print("{:>6} {:>7} {:>12.2f} {:>12.2f} {:>12.2f} {:>9.1f} {:>26}\n",
                       shape == Shape::kChain ? "chain" : "busy", passes, t.describe_us,
                       t.total_us - t.describe_us, t.total_us, t.total_us * 1000 / passes,
                       t.allocations);
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
