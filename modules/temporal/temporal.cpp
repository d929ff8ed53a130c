#include "modules/temporal/temporal.h"

#include "engine/frame_graph/context.h"
#include "modules/temporal/jitter.h"

namespace vellus::temporal {

namespace {

using graph::Access;

struct TaaPush {
    glm::ivec2 size;
    glm::vec2 inverse_size;
    float blend;
    uint32_t history_valid;
};

}  // namespace

void jitter_view(Res<const TemporalSettings> settings, Res<const scene::FixedStep> step,
                 Res<scene::ViewSettings> view) {
    view->jitter =
        settings->enabled ? halton_jitter(static_cast<uint32_t>(step->frame)) : glm::vec2(0.0f);
}

void describe_taa(Res<const TemporalSettings> settings, Res<const scene::ViewSettings> view,
                  Res<TemporalPipelines> pipelines, Res<scene::RenderFrame> frame) {
    if (!settings->enabled) return;
    if (!frame->compute(pipelines->resolve, [] {
            using enum gpu::Binding;
            return gpu::ComputeInfo{.shader = "temporal/taa.comp.glsl",
                                    .bindings = {kSampledNearest, kSampledNearest, kSampledNearest,
                                                 kSampledLinear, kStorage},
                                    .push_bytes = sizeof(TaaPush)};
        })) {
        return;
    }
    graph::History history = frame->graph.history(
        "taa", {gpu::Format::kRgba16Float, frame->size.x, frame->size.y}, view->cut);
    auto pass = frame->graph.add_pass("temporal/taa", graph::PassKind::kCompute);
    pass.read(frame->color, Access::kSampledCompute);
    pass.read(frame->velocity, Access::kSampledCompute);
    pass.read(frame->depth, Access::kSampledCompute);
    pass.read(history.previous, Access::kSampledCompute);
    history.next = pass.write(history.next, Access::kStorageWrite, {}, graph::Load::kDiscard);
    const TaaPush push{glm::ivec2(frame->size), 1.0f / glm::vec2(frame->size), settings->blend, 0};
    pass.execute([push, history, color = frame->color, velocity = frame->velocity,
                  depth = frame->depth,
                  pipeline = pipelines->resolve](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        commands.images({context.view(color), context.view(velocity), context.view(depth),
                         context.view(history.previous), context.view(history.next)});
        TaaPush full = push;
        full.history_valid = context.history_valid(history.previous) ? 1 : 0;
        commands.push(full);
        commands.dispatch((push.size.x + 15) / 16, (push.size.y + 15) / 16);
    });
    frame->color = history.next;
}

}  // namespace vellus::temporal
