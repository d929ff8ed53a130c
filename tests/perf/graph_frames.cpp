#include "tests/perf/graph_frames.h"

#include "engine/frame_graph/context.h"

namespace vellus::bench {

using namespace graph;

const char* name_of(GraphShape shape) {
    return shape == GraphShape::kChain ? "chain" : "busy";
}

void describe_frame(GraphDescription& graph, GraphShape shape, uint32_t passes) {
    constexpr ImageDesc kImage{gpu::Format::kRgba16Float, 1280, 720};
    graph.reset();
    const bool busy = shape == GraphShape::kBusy;
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

}  // namespace vellus::bench
