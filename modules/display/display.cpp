#include "modules/display/display.h"

#include "engine/frame_graph/context.h"

namespace vellus::display {

namespace {

struct TonemapPush {
    glm::ivec2 size;
    float exposure;
    uint32_t padding = 0;
};

}  // namespace

void describe_tonemap(Res<const scene::ViewSettings> view, Res<DisplayPipelines> pipelines,
                      Res<scene::RenderFrame> frame) {
    if (!frame->compute(pipelines->tonemap, [] {
            using enum gpu::Binding;
            return gpu::ComputeInfo{.shader = "display/tonemap.comp.glsl",
                                    .bindings = {kStorage, kStorage},
                                    .push_bytes = sizeof(TonemapPush)};
        })) {
        return;
    }
    frame->display = frame->graph.create_image(
        "display", {gpu::Format::kRgba8Unorm, frame->size.x, frame->size.y});
    auto pass = frame->graph.add_pass("display/tonemap", graph::PassKind::kCompute);
    pass.read(frame->color, graph::Access::kStorageRead);
    frame->display =
        pass.write(frame->display, graph::Access::kStorageWrite, {}, graph::Load::kDiscard);
    const TonemapPush push{glm::ivec2(frame->size), view->exposure};
    pass.execute([push, color = frame->color, display = frame->display,
                  pipeline = pipelines->tonemap](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        commands.images({context.view(color), context.view(display)});
        commands.push(push);
        commands.dispatch((push.size.x + 15) / 16, (push.size.y + 7) / 8);
    });
}

}  // namespace vellus::display
