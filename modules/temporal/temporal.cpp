#include "modules/temporal/temporal.h"

#include "engine/frame_graph/context.h"
#include "modules/temporal/jitter.h"

namespace vellus::temporal {

namespace {

using graph::Access;

constexpr glm::ivec2 kTile(32, 16);  // pixels of a group of threads
constexpr int kWindow = 2;           // pixels that hair is felt beyond itself

struct TaaPush {
    glm::ivec2 size;
    glm::ivec2 first;
    glm::ivec2 end;
    glm::vec2 inverse_size;
    float blend;
    uint32_t history_valid;
};

bool make_pipeline(const gpu::Pipeline*& slot, bool hair, scene::RenderFrame& frame) {
    return frame.compute(slot, [&] {
        using enum gpu::Binding;
        return gpu::ComputeInfo{
            .shader = "temporal/taa.comp.glsl",
            .bindings = {kStorage, kStorage, kSampledNearest, kStorage, kStorage},
            .push_bytes = sizeof(TaaPush),
            .constants = {hair ? 1U : 0U}};
    });
}

void dispatch(gpu::CommandBuffer& commands, TaaPush push, const scene::PixelRect& region) {
    if (region.empty()) return;
    push.first = region.first;
    push.end = region.end;
    commands.push(push);
    const glm::ivec2 groups = (region.end - region.first + kTile - 1) / kTile;
    commands.dispatch(groups.x, groups.y);
}

}  // namespace

TaaRegions cut_regions(const scene::PixelRect& hair, const glm::ivec2& size) {
    if (hair.empty()) return {{}, {{{{0, 0}, size}}}};
    const glm::ivec2 low = glm::max(hair.first - kWindow, 0) / kTile * kTile;
    const glm::ivec2 high = glm::min((hair.end + kWindow + kTile - 1) / kTile * kTile, size);
    return {{low, high},
            {{{{0, 0}, {size.x, low.y}},
              {{0, high.y}, size},
              {{0, low.y}, {low.x, high.y}},
              {{high.x, low.y}, {size.x, high.y}}}}};
}

void jitter_view(Res<const TemporalSettings> settings, Res<const scene::FixedStep> step,
                 Res<scene::ViewSettings> view) {
    view->jitter =
        settings->enabled ? halton_jitter(static_cast<uint32_t>(step->frame)) : glm::vec2(0.0f);
}

void describe_taa(Res<const TemporalSettings> settings, Res<const scene::ViewSettings> view,
                  Res<TemporalPipelines> pipelines, Res<scene::RenderFrame> frame) {
    if (!settings->enabled) return;
    const TaaRegions regions = cut_regions(frame->hair_pixels, glm::ivec2(frame->size));
    if (!make_pipeline(pipelines->resolve, false, *frame)) return;
    if (!regions.hair.empty() && !make_pipeline(pipelines->resolve_hair, true, *frame)) return;
    graph::History history = frame->graph.history(
        "taa", {gpu::Format::kRgba16Float, frame->size.x, frame->size.y}, view->cut);
    auto pass = frame->graph.add_pass("temporal/taa", graph::PassKind::kCompute);
    pass.read(frame->color, Access::kStorageRead);
    pass.read(frame->velocity, Access::kStorageRead);
    pass.read(frame->depth, Access::kSampledCompute);
    pass.read(history.previous, Access::kStorageRead);
    history.next = pass.write(history.next, Access::kStorageWrite, {}, graph::Load::kDiscard);
    const TaaPush push{.size = glm::ivec2(frame->size),
                       .first = {},
                       .end = {},
                       .inverse_size = 1.0f / glm::vec2(frame->size),
                       .blend = settings->blend,
                       .history_valid = 0};
    pass.execute([push, regions, history, color = frame->color, velocity = frame->velocity,
                  depth = frame->depth, pipelines = &*pipelines](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        const auto images = {context.view(color), context.view(velocity), context.view(depth),
                             context.view(history.previous), context.view(history.next)};
        TaaPush full = push;
        full.history_valid = context.history_valid(history.previous) ? 1 : 0;
        commands.bind(*pipelines->resolve);
        commands.images(images);
        for (const scene::PixelRect& region : regions.others) dispatch(commands, full, region);
        if (regions.hair.empty()) return;
        commands.bind(*pipelines->resolve_hair);
        commands.images(images);
        dispatch(commands, full, regions.hair);
    });
    frame->color = history.next;
}

}  // namespace vellus::temporal
