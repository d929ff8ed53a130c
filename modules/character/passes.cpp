#include "modules/character/passes.h"

#include <algorithm>
#include <array>
#include <optional>

#include "engine/frame_graph/context.h"

namespace vellus::character {
namespace {

constexpr uint32_t kSkinGroup = 64;

/// The part of the shadow atlas that belongs to one light.
struct Tile {
    glm::mat4 to_shadow;
    uint32_t left;
    uint32_t size;
};

void set_tile(VkCommandBuffer commands, const Tile& tile) {
    const VkViewport viewport{.x = static_cast<float>(tile.left),
                              .width = static_cast<float>(tile.size),
                              .height = static_cast<float>(tile.size),
                              .maxDepth = 1.0f};
    const VkRect2D scissor{{static_cast<int32_t>(tile.left), 0}, {tile.size, tile.size}};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

struct Tiles {
    std::array<Tile, light::kMaxLights> tile{};
    uint32_t count = 0;
};

Tiles shadow_tiles(const light::LightBlock& block) {
    Tiles tiles;
    for (uint32_t i = 0; i < block.count; ++i) {
        const light::PunctualLight& light = block.light[i];
        if (light.shadow_tile == light::kNoShadow) continue;
        tiles.tile[tiles.count++] = {light.to_opaque, light.shadow_tile * light.opaque_size,
                                     light.opaque_size};
    }
    return tiles;
}

}  // namespace

void record_skinning(gpu::CommandBuffer& commands, std::span<const MeshDraw> draws,
                     const MeshPipelines& pipelines, VkDeviceAddress skinned) {
    std::optional<bool> bound;
    for (const MeshDraw& draw : draws) {
        if (bound != draw.covered) {
            commands.bind(draw.covered ? *pipelines.skin_covered : *pipelines.skin);
        }
        bound = draw.covered;
        SkinPush push = draw.skin;
        push.skinned += skinned;
        push.skinned_cover += skinned;
        commands.push(push);
        commands.dispatch_threads(push.vertex_count, kSkinGroup);
    }
}

void record_meshes(gpu::CommandBuffer& commands, std::span<const MeshDraw> draws,
                   const std::array<DrawPipelines, 2>& pipelines, VkDeviceAddress skinned,
                   const gpu::UniformSlice& view, const gpu::UniformSlice& lights,
                   VkImageView opaque_shadows) {
    const gpu::Pipeline* bound = nullptr;
    VkImageView sampled = VK_NULL_HANDLE;
    for (const MeshDraw& draw : draws) {
        if (!draw.in_view) continue;
        const DrawPipelines& kind = pipelines[draw.covered ? 1 : 0];
        const gpu::Pipeline* pipeline = draw.two_sided ? kind.two_sided : kind.one_sided;
        if (pipeline != bound) commands.bind(*pipeline);
        if (pipeline != bound || draw.base_color != sampled) {
            commands.images({draw.base_color, opaque_shadows}, {view, lights});
        }
        bound = pipeline;
        sampled = draw.base_color;
        MeshPush push = draw.mesh;
        push.vertices = skinned + draw.skin.skinned;
        push.cover = skinned + draw.skin.skinned_cover;
        commands.push(push);
        commands.draw_indexed(draw.indices, draw.index_count);
    }
}

void record_shadow(gpu::CommandBuffer& commands, std::span<const MeshDraw> draws,
                   const MeshPipelines& pipelines, VkDeviceAddress skinned,
                   const glm::mat4& to_shadow) {
    commands.bind(*pipelines.shadow);
    for (const MeshDraw& draw : draws) {
        commands.push(ShadowPush{to_shadow, skinned + draw.skin.skinned});
        commands.draw_indexed(draw.indices, draw.index_count);
    }
}

void gather_meshes(MeshQuery meshes, Res<const scene::SceneLibrary> scenes,
                   Res<const MeshLibrary> library, Res<const DeformColumns> columns,
                   Res<const scene::ViewState> view, Res<scene::RenderFrame> frame,
                   Res<MeshDraws> draws) {
    collect_draws(meshes, *scenes, *library, *columns, *view, frame->uploads, *draws);
}

void describe_skinning(Res<const MeshDraws> draws, Res<MeshLibrary> library,
                       Res<scene::RenderFrame> frame, Res<MeshPasses> passes) {
    passes->skinned = {};
    if (draws->draws.empty()) return;
    if (std::ranges::any_of(draws->draws, &MeshDraw::covered) &&
        !frame->compute(library->pipelines.skin_covered, [] { return skin_info(true); })) {
        return;
    }
    auto pass = frame->graph.add_pass("character/skin", graph::PassKind::kCompute);
    const auto empty = frame->graph.create_buffer("skinned vertices", {draws->skinned_bytes});
    passes->skinned = pass.write(empty, graph::Access::kStorageWrite, graph::Load::kDiscard);
    pass.execute([skinned = passes->skinned, list = std::span(draws->draws),
                  pipelines = &library->pipelines](graph::PassContext& context) {
        record_skinning(context.commands(), list, *pipelines, context.address(skinned));
    });
}

void describe_mesh_shadows(Res<const MeshDraws> draws, Res<const MeshLibrary> library,
                           Res<const light::LightSet> lights, Res<scene::RenderFrame> frame,
                           Res<const MeshPasses> passes) {
    const Tiles tiles = shadow_tiles(lights->block);
    if (tiles.count == 0 || !passes->skinned || !frame->opaque_shadows) return;
    auto pass = frame->graph.add_pass("character/shadows", graph::PassKind::kRaster);
    pass.read(passes->skinned, graph::Access::kGraphicsStorageRead);
    frame->opaque_shadows = pass.depth(frame->opaque_shadows);
    pass.execute([skinned = passes->skinned, tiles, list = std::span(draws->draws),
                  pipelines = &library->pipelines](graph::PassContext& context) {
        for (uint32_t i = 0; i < tiles.count; ++i) {
            set_tile(context.commands().handle(), tiles.tile[i]);
            record_shadow(context.commands(), list, *pipelines, context.address(skinned),
                          tiles.tile[i].to_shadow);
        }
    });
}

void describe_meshes(Res<const MeshDraws> draws, Res<const light::LightSet> lights,
                     Res<MeshLibrary> library, Res<scene::RenderFrame> frame,
                     Res<const MeshPasses> passes) {
    const auto seen = [](const MeshDraw& draw) { return draw.in_view; };
    if (!passes->skinned || std::ranges::none_of(draws->draws, seen)) return;
    const uint32_t light_count = lights->block.count;
    const HairOnMeshes hair = frame->hair_layers    ? HairOnMeshes::kLayers
                              : frame->hair_shadows ? HairOnMeshes::kClosest
                                                    : HairOnMeshes::kNone;
    auto& pipelines = library->pipelines.draw[light_count][static_cast<size_t>(hair)];
    const auto make = [&](bool covered) {
        const auto info = [=](bool cull_back) {
            return [=] { return draw_info(light_count, hair, covered, cull_back); };
        };
        DrawPipelines& pair = pipelines[covered ? 1 : 0];
        return frame->raster(pair.one_sided, info(true)) &&
               frame->raster(pair.two_sided, info(false));
    };
    for (const bool covered : {false, true}) {
        const auto called_for = [&](const MeshDraw& draw) {
            return draw.in_view && draw.covered == covered;
        };
        if (std::ranges::any_of(draws->draws, called_for) && !make(covered)) return;
    }
    auto pass = frame->graph.add_pass("character/meshes", graph::PassKind::kRaster);
    frame->color = pass.color(frame->color);
    frame->velocity = pass.color(frame->velocity);
    frame->depth = pass.depth(frame->depth);
    const graph::ImageHandle shadows = frame->opaque_shadows;
    pass.read(passes->skinned, graph::Access::kGraphicsStorageRead);
    if (shadows) pass.read(shadows, graph::Access::kSampledFragment);
    if (frame->hair_shadows) pass.read(frame->hair_shadows, graph::Access::kGraphicsStorageRead);
    if (frame->hair_layers) pass.read(frame->hair_layers, graph::Access::kGraphicsStorageRead);
    pass.execute([skinned = passes->skinned, shadows, list = std::span(draws->draws),
                  view = frame->view_block, lights = frame->lights_block, pipelines,
                  white = library->white.view()](graph::PassContext& context) {
        record_meshes(context.commands(), list, pipelines, context.address(skinned), view, lights,
                      shadows ? context.view(shadows) : white);
    });
}

}  // namespace vellus::character
