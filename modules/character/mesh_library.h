#pragma once

#include <array>
#include <vector>

#include "engine/asset/scene_asset.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"
#include "engine/gpu/pipeline_library.h"
#include "engine/platform/result.h"
#include "modules/light/light_data.h"

namespace vellus::scene {
struct SceneLibrary;
}

namespace vellus::character {

/// One triangle primitive on the device.
struct MeshBuffers {
    gpu::Buffer vertices;   ///< RestVertex
    gpu::Buffer morphs;     ///< MorphDelta, target by target
    gpu::Buffer texcoords;  ///< empty where there are none
    gpu::Buffer colors;     ///< empty where there are none
    gpu::Buffer indices;    ///< 32 bit
    uint32_t vertex_count = 0;
    uint32_t index_count = 0;
    uint32_t target_count = 0;
    bool has_joints = false;
    uint32_t material = asset::kNone;

    /// Weights are divided by their sum. Errors name the column that did not fit.
    static Result<MeshBuffers> upload(gpu::Device& device, const asset::Primitive& primitive);
    [[nodiscard]] uint64_t bytes() const;
};

/// All of one asset that drawing needs: per mesh its triangle primitives, and the materials'
/// images.
struct AssetMeshes {
    std::vector<std::vector<MeshBuffers>> meshes;
    std::vector<gpu::Image> images;  ///< by asset image; empty where no material samples it
};

/// What draws meshes under one number of lights, with or without shadows of hair and a SkyCover.
struct DrawPipelines {
    const gpu::Pipeline* one_sided = nullptr;  ///< back faces culled
    const gpu::Pipeline* two_sided = nullptr;  ///< nothing culled
};

struct MeshPipelines {
    const gpu::Pipeline* skin = nullptr;
    const gpu::Pipeline* skin_covered = nullptr;  ///< made when a frame first calls for it
    const gpu::Pipeline* shadow = nullptr;
    /// By number of lights, HairOnMeshes, and whether a SkyCover lies on them; made when a frame
    /// first calls for one.
    std::array<std::array<std::array<DrawPipelines, 2>, 3>, light::kMaxLights + 1> draw;
};

/// What of hair's shadows a frame has for meshes to look up.
enum class HairOnMeshes : uint8_t { kNone, kClosest, kLayers };

/// How to make MeshPipelines::skin and skin_covered.
gpu::ComputeInfo skin_info(bool covered);

/// How to make one of MeshPipelines::draw.
gpu::RasterInfo draw_info(uint32_t lights, HairOnMeshes hair, bool covered, bool cull_back);

/// Meshes on the device, by asset index of the SceneLibrary. Resource.
struct MeshLibrary {
    std::vector<AssetMeshes> assets;
    gpu::Image white;  ///< one texel, for materials without image and frames without shadows
    MeshPipelines pipelines;

    /// Uploads the assets that are not there yet and makes the pipelines, outside the frame. Errors
    /// name the resource that did not fit.
    Result<void> update(gpu::Device& device, const scene::SceneLibrary& library);
    [[nodiscard]] uint64_t bytes() const;
};

}  // namespace vellus::character
