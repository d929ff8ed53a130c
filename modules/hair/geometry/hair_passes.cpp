#include "modules/hair/geometry/hair_passes.h"

#include <algorithm>
#include <span>

#include "engine/frame_graph/context.h"

namespace vellus::hair {

namespace {

using graph::Access;
using graph::PassContext;
using graph::PassKind;

/// Push constants of shaders/hair/shadow/shadow_depth.comp.glsl.
struct ShadowDepthPush {
    VkDeviceAddress projected;
    VkDeviceAddress segment_point;
    VkDeviceAddress segment_strand;
    VkDeviceAddress strand_seed;
    VkDeviceAddress target;
    glm::ivec2 size;
    uint32_t segment_count;
    float alpha;
};
static_assert(sizeof(ShadowDepthPush) == 56);

constexpr int kShadeTile = 32;  // pixels along a side; kTile of shaders/hair/scattering/shade.glsl

/// Push constants of shaders/hair/scattering/shade.comp.glsl.
struct ShadePush {
    VkDeviceAddress visibility;
    VkDeviceAddress projected;
    uint32_t first_id;
    uint32_t segment_count;
    scene::PixelRect rect;
    int32_t width;
    uint32_t padding = 0;
};
static_assert(sizeof(ShadePush) == 48);

gpu::ComputeInfo compute_info(std::string_view shader, uint32_t push_bytes,
                              std::vector<gpu::Binding> bindings = {},
                              std::vector<uint32_t> constants = {}) {
    return {.shader = std::string(shader),
            .bindings = std::move(bindings),
            .push_bytes = push_bytes,
            .constants = std::move(constants)};
}

ProjectPush project_push(const HairDraw& draw, const glm::mat4& to_clip, glm::vec2 viewport,
                         float pixels_per_metre) {
    const StrandBuffers& strands = *draw.strands;
    return {.to_clip = to_clip,
            .positions = draw.positions,
            .parameters = strands.parameters.address(),
            .widths = strands.widths.address(),
            .projected = 0,
            .viewport = viewport,
            .point_count = draw.point_count,
            .width = draw.width,
            .tip_scale = draw.tip_scale,
            .pixels_per_metre = pixels_per_metre * draw.scale};
}

}  // namespace

void assign_hair_shadows(Res<const HairFrame> hair, Res<light::LightSet> lights,
                         Res<HairShadowMaps> maps, Res<scene::RenderFrame> frame) {
    light::LightBlock& block = lights->block;
    if (hair->casters.empty() || block.tiles == 0) return;
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < block.count; ++i) {
        bytes += uint64_t{4} * block.light[i].hair_size * block.light[i].hair_size;
    }
    if (maps->depth.bytes() < bytes) {
        if (auto idle = frame->device->wait_idle(); !idle) return frame->fail(idle.error());
        auto buffer = gpu::Buffer::create(*frame->device, bytes, gpu::MemoryKind::kDevice,
                                          "hair shadow maps");
        if (!buffer) return frame->fail(buffer.error());
        maps->depth = std::move(*buffer);
    }
    VkDeviceAddress next = maps->depth.address();
    for (uint32_t i = 0; i < block.count; ++i) {
        light::PunctualLight& light = block.light[i];
        if (light.shadow_tile == light::kNoShadow) continue;
        light.hair_depth = next;
        next += uint64_t{4} * light.hair_size * light.hair_size;
    }
    if (!wants_layers(*hair)) return;
    auto assigned = assign_layers(*hair, *lights, *frame->device, maps->layers);
    if (!assigned) frame->fail(assigned.error());
}

void describe_hair_projection(Res<HairFrame> hair, Res<HairPipelines> pipelines,
                              Res<FibreLibrary> fibres, Res<scene::RenderFrame> frame) {
    if (hair->draws.empty()) return;
    hair->instance_blocks.clear();
    hair->fibre_blocks.clear();
    for (size_t i = 0; i < hair->instances.size(); ++i) {
        const HairInstance& instance = hair->instances[i];
        const HairDraw& draw = hair->draws[i];
        const auto block = frame->uploads.push_uniform(instance);
        hair->instance_blocks.push_back(block);
        hair->fibre_blocks.push_back(needs_fibre(draw.scattering, draw.multiple, draw.environment)
                                         ? frame->uploads.push_uniform(fibres->fibre(
                                               draw.optics, instance.roughness, instance.shift))
                                         : block);
    }
    describe_card_projection(*hair, pipelines->cards, *frame);
    if (hair->points == 0 || !frame->compute(pipelines->project, [] {
            return compute_info("hair/geometry/project.comp.glsl", sizeof(ProjectPush));
        })) {
        return;
    }
    hair->projected =
        frame->graph.create_buffer("hair projected", {hair->points * kProjectedPointBytes});
    auto pass = frame->graph.add_pass("hair/project", PassKind::kCompute);
    if (hair->deformed) pass.read(hair->deformed, Access::kStorageRead);
    hair->projected = pass.write(hair->projected, Access::kStorageWrite, graph::Load::kDiscard);
    const float pixels_per_metre = 1.0f / frame->pixel_angle;
    pass.execute([draws = std::span<const HairDraw>(hair->draws), pixels_per_metre,
                  viewport = glm::vec2(frame->size), target = hair->projected,
                  pipeline = pipelines->project](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        for (const HairDraw& draw : draws) {
            if (draw.cards) continue;
            ProjectPush push = project_push(draw, draw.to_clip, viewport, pixels_per_metre);
            push.projected = context.address(target) + draw.first_point * kProjectedPointBytes;
            commands.push(push);
            commands.dispatch_threads(push.point_count, kStrandGroupSize);
        }
    });
}

namespace {

bool any_strands(const std::vector<HairDraw>& draws) {
    return std::ranges::any_of(draws, [](const HairDraw& draw) { return draw.cards == nullptr; });
}

/// Points of all strands that cast, as one light sees them.
graph::BufferHandle describe_light_projection(const HairFrame& hair, const light::LightSet& lights,
                                              uint32_t index, const HairPipelines& pipelines,
                                              scene::RenderFrame& frame) {
    uint64_t points = 0;
    for (const HairDraw& draw : hair.casters) points += draw.cards ? 0 : draw.point_count;
    auto projected =
        frame.graph.create_buffer("hair light projected", {points * kProjectedPointBytes});
    auto pass = frame.graph.add_pass("hair/shadow_project", PassKind::kCompute);
    if (hair.deformed) pass.read(hair.deformed, Access::kStorageRead);
    projected = pass.write(projected, Access::kStorageWrite, graph::Load::kDiscard);
    pass.execute([casters = std::span<const HairDraw>(hair.casters), projected,
                  to_hair = lights.world_to_hair[index],
                  pixels = lights.hair_texels_per_metre[index],
                  size = lights.block.light[index].hair_size,
                  pipeline = pipelines.project](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        VkDeviceAddress target = context.address(projected);
        for (const HairDraw& draw : casters) {
            if (draw.cards) continue;
            ProjectPush push =
                project_push(draw, glm::mat4(to_hair * draw.world), glm::vec2(size), pixels);
            push.projected = target;
            commands.push(push);
            commands.dispatch_threads(push.point_count, kStrandGroupSize);
            target += push.point_count * kProjectedPointBytes;
        }
    });
    return projected;
}

/// Closest strand of each texel of one light's map.
graph::BufferHandle describe_strand_shadow(const HairFrame& hair, const light::PunctualLight& light,
                                           graph::BufferHandle projected,
                                           const HairPipelines& pipelines,
                                           scene::RenderFrame& frame, graph::BufferHandle map) {
    auto pass = frame.graph.add_pass("hair/shadow_depth", PassKind::kCompute);
    pass.read(projected, Access::kStorageRead);
    map = pass.write(map, Access::kStorageReadWrite);
    pass.execute([casters = std::span<const HairDraw>(hair.casters), projected,
                  target = light.hair_depth, size = light.hair_size,
                  pipeline = pipelines.shadow_depth](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        VkDeviceAddress points = context.address(projected);
        for (const HairDraw& draw : casters) {
            if (draw.cards) continue;
            const StrandBuffers& strands = *draw.strands;
            commands.push(ShadowDepthPush{.projected = points,
                                          .segment_point = strands.segment_point.address(),
                                          .segment_strand = strands.segment_strand.address(),
                                          .strand_seed = strands.strand_seed.address(),
                                          .target = target,
                                          .size = glm::ivec2(size),
                                          .segment_count = draw.primitives,
                                          .alpha = draw.alpha});
            commands.dispatch_threads(draw.primitives, kStrandGroupSize);
            points += draw.point_count * kProjectedPointBytes;
        }
    });
    return map;
}

}  // namespace

void describe_hair_shadows(Res<HairFrame> hair, Res<const light::LightSet> lights,
                           Res<HairShadowMaps> maps, Res<HairPipelines> pipelines,
                           Res<scene::RenderFrame> frame) {
    if (hair->casters.empty() || lights->block.tiles == 0) return;
    const bool any = any_strands(hair->casters);
    const auto project = [] {
        return compute_info("hair/geometry/project.comp.glsl", sizeof(ProjectPush));
    };
    const auto depth = [] {
        return compute_info("hair/shadow/shadow_depth.comp.glsl", sizeof(ShadowDepthPush));
    };
    if (any && (!frame->compute(pipelines->project, project) ||
                !frame->compute(pipelines->shadow_depth, depth))) {
        return;
    }
    graph::BufferHandle map = frame->graph.import_buffer("hair shadows", {maps->depth.bytes()},
                                                         &maps->depth, Access::kStorageRead);
    auto clear = frame->graph.add_pass("hair/shadow_clear", PassKind::kTransfer);
    map = clear.write(map, Access::kTransferWrite, graph::Load::kDiscard);
    clear.execute([map](PassContext& context) {
        vkCmdFillBuffer(context.commands().handle(), context.buffer(map), 0, VK_WHOLE_SIZE, 0);
    });
    const bool layered = wants_layers(*hair);
    if (layered) {
        hair->layers = frame->graph.import_buffer("hair layers", {maps->layers.bytes()},
                                                  &maps->layers, Access::kStorageRead);
    }
    for (uint32_t index = 0; index < lights->block.count; ++index) {
        const light::PunctualLight& light = lights->block.light[index];
        if (light.shadow_tile == light::kNoShadow) continue;
        const CardShadow cards =
            describe_card_shadow(*hair, *lights, index, pipelines->cards, *frame, map);
        map = cards.map;
        graph::BufferHandle projected;
        if (any) {
            projected = describe_light_projection(*hair, *lights, index, *pipelines, *frame);
            map = describe_strand_shadow(*hair, light, projected, *pipelines, *frame, map);
        }
        if (!layered) continue;
        hair->layers = describe_layers(*hair, *lights, index, {map, projected, cards.vertices},
                                       pipelines->deep, *frame, hair->layers);
    }
    frame->hair_shadows = map;
    frame->hair_layers = hair->layers;
}

namespace {

/// Clears the visibility buffer and rasterises all grooms into it.
graph::BufferHandle describe_visibility(const HairFrame& hair, HairPipelines& pipelines,
                                        scene::RenderFrame& frame) {
    const uint64_t pixels = uint64_t{frame.size.x} * frame.size.y;
    auto target = frame.graph.create_buffer("hair visibility", {pixels * 8});
    auto clear = frame.graph.add_pass("hair/visibility_clear", PassKind::kTransfer);
    target = clear.write(target, Access::kTransferWrite, graph::Load::kDiscard);
    clear.execute([target](PassContext& context) {
        vkCmdFillBuffer(context.commands().handle(), context.buffer(target), 0, VK_WHOLE_SIZE, 0);
    });
    target = describe_card_visibility(hair, pipelines.cards, frame, target);
    if (hair.points == 0) return target;
    auto pass = frame.graph.add_pass("hair/visibility", PassKind::kCompute);
    pass.read(hair.projected, Access::kStorageRead);
    target = pass.write(target, Access::kStorageReadWrite);
    pass.execute([draws = std::span<const HairDraw>(hair.draws), projected = hair.projected, target,
                  size = glm::ivec2(frame.size), index = frame.frame_index,
                  moving = pipelines.visibility,
                  still = pipelines.visibility_still](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        for (const HairDraw& draw : draws) {
            if (draw.cards) continue;
            const StrandBuffers& strands = *draw.strands;
            commands.bind(draw.opacity == OpacityTechnique::kDither ? *moving : *still);
            commands.push(VisibilityPush{
                .projected = context.address(projected) + draw.first_point * kProjectedPointBytes,
                .segment_point = strands.segment_point.address(),
                .segment_strand = strands.segment_strand.address(),
                .strand_seed = strands.strand_seed.address(),
                .target = context.address(target),
                .size = size,
                .segment_count = draw.primitives,
                .first_id = draw.first_id,
                .frame = index,
                .alpha = draw.alpha});
            commands.dispatch_threads(draw.primitives, kStrandGroupSize);
        }
    });
    return target;
}

ShadeConstants shade_constants(const HairDraw& draw, const light::LightBlock& lights) {
    return {lights.count,
            static_cast<uint32_t>(draw.shadow),
            static_cast<uint32_t>(draw.environment),
            lights.opaque_casters > 0 ? 1u : 0u,
            draw.deform != kNotDeformed ? 1u : 0u,
            static_cast<uint32_t>(draw.scattering),
            static_cast<uint32_t>(draw.multiple),
            draw.cards ? 1u : 0u};
}

bool make_pipelines(const HairFrame& hair, const light::LightBlock& lights,
                    HairPipelines& pipelines, scene::RenderFrame& frame) {
    bool ready = true;
    for (const HairDraw& draw : hair.draws) {
        const bool moving = draw.opacity == OpacityTechnique::kDither;
        ready &= draw.cards ||
                 frame.compute(moving ? pipelines.visibility : pipelines.visibility_still, [&] {
                     return compute_info("hair/geometry/visibility.comp.glsl",
                                         sizeof(VisibilityPush), {}, {moving ? 0u : 1u});
                 });
        const ShadeConstants constants = shade_constants(draw, lights);
        ready &= frame.compute(pipelines.shade[constants], [&] {
            using enum gpu::Binding;
            const gpu::EmbeddedShader* added = added_stage(draw.scattering);
            if (added) frame.device->pipelines().embed(*added);
            return compute_info(added ? added->path : "hair/scattering/shade.comp.glsl",
                                sizeof(ShadePush),
                                {kSampledNearest, kSampledNearest, kStorage, kStorage, kUniform,
                                 kUniform, kUniform, kUniform},
                                {constants.begin(), constants.end()});
        });
    }
    return ready;
}

}  // namespace

void describe_hair(Res<HairFrame> hair, Res<const light::LightSet> lights,
                   Res<HairPipelines> pipelines, Res<scene::RenderFrame> frame) {
    if (hair->draws.empty() || (!hair->projected && !hair->card_vertices)) return;
    if (!make_pipelines(*hair, lights->block, *pipelines, *frame)) return;
    const auto visibility = hair->visibility = describe_visibility(*hair, *pipelines, *frame);

    for (const HairDraw& draw : hair->draws) {
        frame->hair_pixels = scene::around(frame->hair_pixels, draw.rect);
    }
    auto pass = frame->graph.add_pass("hair/shade", PassKind::kCompute);
    pass.read(visibility, Access::kStorageRead);
    if (hair->points > 0) pass.read(hair->projected, Access::kStorageRead);
    if (hair->card_points > 0) pass.read(hair->card_vertices, Access::kStorageRead);
    if (hair->deformed) pass.read(hair->deformed, Access::kStorageRead);
    if (lights->block.tiles > 0 && !hair->casters.empty()) {
        pass.read(frame->hair_shadows, Access::kStorageRead);
    }
    if (hair->layers) pass.read(hair->layers, Access::kStorageRead);
    pass.read(frame->depth, Access::kSampledCompute);
    pass.read(frame->opaque_shadows, Access::kSampledCompute);
    frame->color = pass.write(frame->color, Access::kStorageWrite);
    frame->velocity = pass.write(frame->velocity, Access::kStorageWrite);
    pass.execute([hair = &*hair, pipelines = &*pipelines, block = &lights->block,
                  view_block = frame->view_block, lights_block = frame->lights_block,
                  width = static_cast<int32_t>(frame->size.x), visibility,
                  projected = hair->projected, vertices = hair->card_vertices, depth = frame->depth,
                  shadows = frame->opaque_shadows, color = frame->color,
                  velocity = frame->velocity](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        for (size_t i = 0; i < hair->draws.size(); ++i) {
            const HairDraw& draw = hair->draws[i];
            commands.bind(*pipelines->shade[shade_constants(draw, *block)]);
            commands.images(
                {context.view(depth), context.view(shadows), context.view(color),
                 context.view(velocity)},
                {view_block, lights_block, hair->instance_blocks[i], hair->fibre_blocks[i]});
            commands.push(ShadePush{.visibility = context.address(visibility),
                                    .projected = draw.cards
                                                     ? context.address(vertices) +
                                                           draw.first_card_point * kCardVertexBytes
                                                     : context.address(projected),
                                    .first_id = draw.first_id,
                                    .segment_count = draw.primitives,
                                    .rect = draw.rect,
                                    .width = width});
            const glm::ivec2 groups =
                (draw.rect.end - draw.rect.first + kShadeTile - 1) / kShadeTile;
            commands.dispatch(groups.x, groups.y);
        }
    });
}

}  // namespace vellus::hair
