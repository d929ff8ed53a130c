#pragma once

#include <span>
#include <vector>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/character/deform.h"
#include "modules/character/mesh_data.h"
#include "modules/character/mesh_library.h"
#include "modules/scene/view.h"

namespace vellus::gpu {
class UploadRing;
}

namespace vellus::character {

/// One primitive of one entity. Addresses of the frame's buffers are offsets until the passes know
/// where those lie.
struct MeshDraw {
    SkinPush skin;  ///< `skinned`: bytes into the frame's skinned vertices
    MeshPush mesh;
    VkBuffer indices = VK_NULL_HANDLE;
    uint32_t index_count = 0;
    VkImageView base_color = VK_NULL_HANDLE;
    bool two_sided = false;
    bool covered = false;  ///< keeps `skinned_cover`: bytes into the frame's skinned vertices
    bool in_view = true;
};

/// What this frame draws. Resource, filled by gather_meshes.
struct MeshDraws {
    std::vector<MeshDraw> draws;
    uint64_t skinned_bytes = 0;
    float hair_falloff = 80.0f;  ///< 1/m: extinction behind the closest hair, on skin

    std::vector<glm::mat4x3> palette;  ///< camera-relative, this frame's then the last's
};

/// Camera-relative palettes, this frame's then the last's, the subtraction done in double.
void relative_palettes(const DeformColumns& columns, const glm::dvec3& camera,
                       std::vector<glm::mat4x3>& out);

using MeshQuery =
    Query<const scene::MeshInstance, const MeshSlot, const scene::WorldBounds, const SkyCover*>;

/// Lists the draws of all meshes that the library holds and pushes palettes and weights to the
/// ring. Draws nothing where the ring is full (the ring reports it).
void collect_draws(const MeshQuery& meshes, const scene::SceneLibrary& scenes,
                   const MeshLibrary& library, const DeformColumns& columns,
                   const scene::ViewState& view, gpu::UploadRing& uploads, MeshDraws& out);

}  // namespace vellus::character
