#include "modules/character/mesh_draws.h"

#include <algorithm>

#include "engine/gpu/upload_ring.h"

namespace vellus::character {
namespace {

/// Addresses of the frame's palettes and weights on the device.
struct Columns {
    VkDeviceAddress palette = 0;
    VkDeviceAddress previous_palette = 0;
    VkDeviceAddress weights = 0;
    VkDeviceAddress previous_weights = 0;
};

/// Whether any part of the box may be seen: false if all corners lie beyond one clip plane.
bool in_view(const scene::ViewState& view, const scene::Box& box) {
    if (box.empty()) return true;
    uint32_t outside = 0x1f;
    for (const glm::dvec3& corner : box.corners()) {
        const glm::vec4 p = view.view.view_projection * glm::vec4(view.relative(corner), 1.0f);
        uint32_t here = 0;
        if (p.x < -p.w) here |= 1U;
        if (p.x > p.w) here |= 2U;
        if (p.y < -p.w) here |= 4U;
        if (p.y > p.w) here |= 8U;
        if (p.w < view.view.near_plane) here |= 16U;
        outside &= here;
    }
    return outside == 0;
}

SkinPush skin_push(const MeshBuffers& mesh, const MeshSlot& slot, const Columns& columns,
                   uint64_t skinned) {
    SkinPush push;
    push.rest = mesh.vertices.address();
    push.morphs = mesh.morphs.address();
    push.palette = columns.palette + slot.first_joint * sizeof(glm::mat4x3);
    push.previous_palette = columns.previous_palette + slot.first_joint * sizeof(glm::mat4x3);
    push.weights = columns.weights + slot.first_weight * sizeof(float);
    push.previous_weights = columns.previous_weights + slot.first_weight * sizeof(float);
    push.skinned = skinned;
    push.vertex_count = mesh.vertex_count;
    push.target_count = mesh.target_count;
    push.has_joints = mesh.has_joints ? 1 : 0;
    return push;
}

/// Lets primitive `index`, whose vertices begin at `first_vertex` of its mesh, be covered; the
/// frame's covers lie after its vertices.
void add_cover(const SkyCover& cover, size_t index, uint64_t first_vertex, uint64_t skinned,
               MeshDraw& draw) {
    if (cover.thickness <= 0.0f) return;
    if ((cover.primitives >> std::min<size_t>(index, 63) & 1U) == 0) return;
    draw.covered = true;
    draw.skin.cover = cover.vertices + first_vertex * sizeof(CoveredVertex);
    draw.skin.skinned_cover = skinned;
    draw.skin.cover_thickness = cover.thickness;
    draw.skin.cover_forward = cover.forward;
    draw.skin.cover_backward = cover.backward;
}

float alpha_cutoff(const asset::Material& material) {
    if (material.alpha_mode == asset::AlphaMode::kOpaque) return 0.0f;
    return material.alpha_mode == asset::AlphaMode::kMask ? std::max(material.alpha_cutoff, 1e-6f)
                                                          : -1.0f;
}

MeshPush mesh_push(const MeshBuffers& mesh, const asset::Material& material, bool mirrored) {
    MeshPush push;
    push.texcoords = mesh.texcoords.address();
    push.colors = mesh.colors.address();
    push.base_color = material.base_color;
    push.emissive = material.emissive;
    push.metallic = material.metallic;
    push.roughness = material.roughness;
    push.alpha_cutoff = alpha_cutoff(material);
    push.back_flip = material.double_sided && !mirrored ? -1.0f : 1.0f;
    push.front_flip = material.double_sided && mirrored ? -1.0f : 1.0f;
    return push;
}

MeshDraw make_draw(const MeshBuffers& mesh, const asset::SceneAsset& scene,
                   const AssetMeshes& uploaded, const MeshLibrary& library, bool mirrored) {
    static const asset::Material kDefault;
    const bool given = mesh.material < scene.materials.size();
    const asset::Material& material = given ? scene.materials[mesh.material] : kDefault;
    MeshDraw draw;
    draw.mesh = mesh_push(mesh, material, mirrored);
    draw.indices = mesh.indices.handle();
    draw.index_count = mesh.index_count;
    const uint32_t image = material.base_color_image;
    const bool sampled = image < uploaded.images.size() && uploaded.images[image];
    draw.base_color = sampled ? uploaded.images[image].view() : library.white.view();
    draw.two_sided = material.double_sided || mirrored;
    return draw;
}

Columns push_columns(const DeformColumns& columns, const std::vector<glm::mat4x3>& palette,
                     gpu::UploadRing& uploads) {
    Columns result;
    if (palette.empty()) return result;
    result.palette = uploads.push_span(std::span<const glm::mat4x3>(palette));
    if (result.palette == 0) return result;
    result.previous_palette = result.palette + columns.joints.size() * sizeof(glm::mat4x3);
    if (columns.weights.empty()) return result;
    result.weights = uploads.push_span(std::span<const float>(columns.weights));
    result.previous_weights = uploads.push_span(std::span<const float>(columns.previous_weights));
    if (result.weights == 0 || result.previous_weights == 0) result.palette = 0;
    return result;
}

}  // namespace

void relative_palettes(const DeformColumns& columns, const glm::dvec3& camera,
                       std::vector<glm::mat4x3>& out) {
    out.clear();
    for (const glm::dmat4& m : columns.palette) out.push_back(scene::relative_affine(m, camera));
    for (const glm::dmat4& m : columns.previous_palette) {
        out.push_back(scene::relative_affine(m, camera));
    }
}

void collect_draws(const MeshQuery& meshes, const scene::SceneLibrary& scenes,
                   const MeshLibrary& library, const DeformColumns& columns,
                   const scene::ViewState& view, gpu::UploadRing& uploads, MeshDraws& out) {
    out.draws.clear();
    out.skinned_bytes = 0;
    relative_palettes(columns, view.pose.position, out.palette);
    const Columns addresses = push_columns(columns, out.palette, uploads);
    if (addresses.palette == 0) return;
    meshes.each([&](const scene::MeshInstance& instance, const MeshSlot& slot,
                    const scene::WorldBounds& bounds, const SkyCover* cover) {
        if (instance.asset >= library.assets.size()) return;
        const AssetMeshes& uploaded = library.assets[instance.asset];
        const bool visible = in_view(view, bounds.box);
        const bool mirrored = glm::determinant(glm::dmat3(columns.palette[slot.first_joint])) < 0.0;
        uint64_t first_vertex = 0;
        for (size_t i = 0; i < uploaded.meshes[instance.mesh].size(); ++i) {
            const MeshBuffers& mesh = uploaded.meshes[instance.mesh][i];
            MeshDraw draw =
                make_draw(mesh, *scenes.assets[instance.asset], uploaded, library, mirrored);
            draw.mesh.hair_falloff = out.hair_falloff;
            draw.skin = skin_push(mesh, slot, addresses, out.skinned_bytes);
            draw.in_view = visible;
            out.skinned_bytes += mesh.vertex_count * sizeof(SkinnedVertex);
            if (cover != nullptr) add_cover(*cover, i, first_vertex, out.skinned_bytes, draw);
            if (draw.covered) out.skinned_bytes += mesh.vertex_count * sizeof(SkinnedCover);
            first_vertex += mesh.vertex_count;
            out.draws.push_back(draw);
        }
    });
}

}  // namespace vellus::character
