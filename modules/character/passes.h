#pragma once

#include "engine/gpu/command_buffer.h"
#include "modules/character/mesh_draws.h"
#include "modules/light/light_set.h"
#include "modules/scene/render_frame.h"

namespace vellus::character {

/// The skinned vertices of the frame being described. Resource.
struct MeshPasses {
    graph::BufferHandle skinned;  ///< invalid where there is nothing to draw
};

/// System, stage skinning: this frame's draws.
void gather_meshes(MeshQuery meshes, Res<const scene::SceneLibrary> scenes,
                   Res<const MeshLibrary> library, Res<const DeformColumns> columns,
                   Res<const scene::ViewState> view, Res<scene::RenderFrame> frame,
                   Res<MeshDraws> draws);

/// System, stage skinning: pass "character/skin", one dispatch per primitive.
void describe_skinning(Res<const MeshDraws> draws, Res<MeshLibrary> library,
                       Res<scene::RenderFrame> frame, Res<MeshPasses> passes);

/// System, stage casters: pass "character/shadows" draws all meshes into each light's tile of
/// RenderFrame::opaque_shadows.
void describe_mesh_shadows(Res<const MeshDraws> draws, Res<const MeshLibrary> library,
                           Res<const light::LightSet> lights, Res<scene::RenderFrame> frame,
                           Res<const MeshPasses> passes);

/// System, stage opaque: pass "character/meshes" draws what is in view.
void describe_meshes(Res<const MeshDraws> draws, Res<const light::LightSet> lights,
                     Res<MeshLibrary> library, Res<scene::RenderFrame> frame,
                     Res<const MeshPasses> passes);

/// What the passes record; `skinned` is the address of the frame's skinned vertices.
void record_skinning(gpu::CommandBuffer& commands, std::span<const MeshDraw> draws,
                     const MeshPipelines& pipelines, VkDeviceAddress skinned);
void record_meshes(gpu::CommandBuffer& commands, std::span<const MeshDraw> draws,
                   const std::array<DrawPipelines, 2>& pipelines, VkDeviceAddress skinned,
                   const gpu::UniformSlice& view, const gpu::UniformSlice& lights,
                   VkImageView opaque_shadows);
void record_shadow(gpu::CommandBuffer& commands, std::span<const MeshDraw> draws,
                   const MeshPipelines& pipelines, VkDeviceAddress skinned,
                   const glm::mat4& to_shadow);

}  // namespace vellus::character
