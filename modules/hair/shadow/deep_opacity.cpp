#include "modules/hair/shadow/deep_opacity.h"

#include <algorithm>
#include <span>

#include "engine/frame_graph/context.h"
#include "modules/hair/cards/card_passes.h"
#include "modules/hair/geometry/strand_raster.h"
#include "modules/hair/shadow/deep_opacity_glsl.h"

namespace vellus::hair {

namespace {

using graph::Access;
using graph::PassContext;
using graph::PassKind;

/// Layers but the last reach this share of the largest groom deep, the last all through it
/// (kDeepReach): beyond, on a head's far side, little light is left to tell.
constexpr float kSpan = 0.3f;

/// DeepTarget of shaders/hair/shadow/deep_add.glsl.
struct DeepTarget {
    VkDeviceAddress layers;
    int32_t size;
    uint32_t sun;
    float range;
    float span;
};

struct FrontPush {
    VkDeviceAddress depth;
    VkDeviceAddress layers;
    int32_t size;
    uint32_t padding = 0;
};
static_assert(sizeof(FrontPush) == 24);

struct LayersPush {
    VkDeviceAddress projected;
    VkDeviceAddress segment_point;
    DeepTarget target;
    uint32_t segment_count;
    float alpha;
};
static_assert(sizeof(LayersPush) == 48);

struct CardLayersPush {
    VkDeviceAddress cards;
    VkDeviceAddress vertices;
    DeepTarget target;
    float alpha;
    uint32_t threads;
    uint32_t triangle_count;
    uint32_t padding = 0;
};
static_assert(sizeof(CardLayersPush) == 56);

uint64_t bytes_of(const light::PunctualLight& light) {
    return uint64_t{4} * glsl::kDeepWords * (light.hair_size / 2) * (light.hair_size / 2);
}

DeepTarget target_of(const light::PunctualLight& light) {
    return {.layers = light.hair_layers,
            .size = static_cast<int32_t>(light.layers_size),
            .sun = light.kind == light::PunctualKind::kSun ? 1U : 0U,
            .range = light.hair_range,
            .span = light.layers_span};
}

gpu::ComputeInfo info(const char* shader, uint32_t push_bytes) {
    return {.shader = shader, .bindings = {}, .push_bytes = push_bytes, .constants = {}};
}

graph::BufferHandle describe_front(const light::PunctualLight& light, graph::BufferHandle depth,
                                   const gpu::Pipeline* pipeline, scene::RenderFrame& frame,
                                   graph::BufferHandle layers) {
    auto pass = frame.graph.add_pass("hair/deep_front", PassKind::kCompute);
    pass.read(depth, Access::kStorageRead);
    layers = pass.write(layers, Access::kStorageReadWrite);
    const FrontPush push{.depth = light.hair_depth,
                         .layers = light.hair_layers,
                         .size = static_cast<int32_t>(light.layers_size)};
    pass.execute([push, pipeline](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        commands.push(push);
        const auto groups = static_cast<uint32_t>((push.size + 7) / 8);
        commands.dispatch(groups, groups);
    });
    return layers;
}

graph::BufferHandle describe_strands(const HairFrame& hair, const light::PunctualLight& light,
                                     graph::BufferHandle points, const gpu::Pipeline* pipeline,
                                     scene::RenderFrame& frame, graph::BufferHandle layers) {
    auto pass = frame.graph.add_pass("hair/deep_layers", PassKind::kCompute);
    pass.read(points, Access::kStorageRead);
    layers = pass.write(layers, Access::kStorageReadWrite);
    pass.execute([casters = std::span<const HairDraw>(hair.casters), points,
                  target = target_of(light), pipeline](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        VkDeviceAddress projected = context.address(points);
        for (const HairDraw& draw : casters) {
            if (draw.cards != nullptr) continue;
            commands.push(LayersPush{.projected = projected,
                                     .segment_point = draw.strands->segment_point.address(),
                                     .target = target,
                                     .segment_count = draw.primitives,
                                     .alpha = draw.alpha});
            commands.dispatch_threads(draw.primitives, kStrandGroupSize);
            projected += draw.point_count * kProjectedPointBytes;
        }
    });
    return layers;
}

graph::BufferHandle describe_cards(const HairFrame& hair, const light::PunctualLight& light,
                                   const glm::dmat4& to_hair, graph::BufferHandle vertices,
                                   const gpu::Pipeline* pipeline, scene::RenderFrame& frame,
                                   graph::BufferHandle layers) {
    auto pass = frame.graph.add_pass("hair/deep_layers", PassKind::kCompute);
    pass.read(vertices, Access::kStorageRead);
    layers = pass.write(layers, Access::kStorageReadWrite);
    pass.execute([casters = std::span<const HairDraw>(hair.casters), vertices,
                  target = target_of(light), size = glm::ivec2(light.hair_size), to_hair,
                  pipeline](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        VkDeviceAddress source = context.address(vertices);
        for (const HairDraw& draw : casters) {
            if (draw.cards == nullptr) continue;
            const CardBuffers& cards = *draw.cards;
            const uint32_t threads =
                threads_per_card_triangle(cards, card_pixels(cards, to_hair * draw.world, size));
            commands.push(CardLayersPush{.cards = cards.set.address(),
                                         .vertices = source,
                                         .target = target,
                                         .alpha = draw.alpha,
                                         .threads = threads,
                                         .triangle_count = cards.triangle_count});
            commands.dispatch_threads(cards.triangle_count * threads, kTriangleGroupSize);
            source += cards.point_count * kCardVertexBytes;
        }
    });
    return layers;
}

}  // namespace

bool wants_layers(const HairFrame& hair) {
    return std::ranges::any_of(hair.draws, [](const HairDraw& draw) {
        return draw.shadow == ShadowTechnique::kDeepOpacity;
    });
}

Result<void> assign_layers(const HairFrame& hair, light::LightSet& lights, gpu::Device& device,
                           gpu::Buffer& memory) {
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < lights.block.count; ++i) bytes += bytes_of(lights.block.light[i]);
    if (memory.bytes() < bytes) {
        if (auto idle = device.wait_idle(); !idle) return idle;
        auto buffer =
            gpu::Buffer::create(device, bytes, gpu::MemoryKind::kDevice, "hair shadow layers");
        if (!buffer) return buffer.error();
        memory = std::move(*buffer);
    }
    VkDeviceAddress next = memory.address();
    for (uint32_t i = 0; i < lights.block.count; ++i) {
        light::PunctualLight& light = lights.block.light[i];
        if (light.shadow_tile == light::kNoShadow) continue;
        light.hair_layers = next;
        light.layers_size = light.hair_size / 2;
        light.layers_span = kSpan * hair.largest_caster;
        next += bytes_of(light);
    }
    return {};
}

graph::BufferHandle describe_layers(const HairFrame& hair, const light::LightSet& lights,
                                    uint32_t index, const DeepSources& sources,
                                    DeepPipelines& pipelines, scene::RenderFrame& frame,
                                    graph::BufferHandle layers) {
    const light::PunctualLight& light = lights.block.light[index];
    const auto made = [&](const gpu::Pipeline*& slot, const char* shader, uint32_t bytes) {
        return frame.compute(slot, [&] { return info(shader, bytes); });
    };
    if (!made(pipelines.front, "hair/shadow/deep_front.comp.glsl", sizeof(FrontPush)) ||
        (sources.points &&
         !made(pipelines.layers, "hair/shadow/deep_layers.comp.glsl", sizeof(LayersPush))) ||
        (sources.card_vertices && !made(pipelines.card_layers, "hair/cards/deep_layers.comp.glsl",
                                        sizeof(CardLayersPush)))) {
        return layers;
    }
    layers = describe_front(light, sources.depth, pipelines.front, frame, layers);
    if (sources.points) {
        layers = describe_strands(hair, light, sources.points, pipelines.layers, frame, layers);
    }
    if (sources.card_vertices) {
        layers = describe_cards(hair, light, lights.world_to_hair[index], sources.card_vertices,
                                pipelines.card_layers, frame, layers);
    }
    return layers;
}

}  // namespace vellus::hair
