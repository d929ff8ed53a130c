#include "modules/character/mesh_library.h"

#include <fmt/format.h>

#include "modules/character/mesh_data.h"
#include "modules/scene/library.h"

namespace vellus::character {
namespace {

std::vector<RestVertex> rest_vertices(const asset::Primitive& primitive) {
    std::vector<RestVertex> vertices(primitive.positions.size());
    const bool skinned = !primitive.joints.empty() && !primitive.weights.empty();
    for (size_t i = 0; i < vertices.size(); ++i) {
        RestVertex& v = vertices[i];
        v.position = primitive.positions[i];
        if (!primitive.normals.empty()) v.normal = primitive.normals[i];
        if (!skinned) continue;
        v.joints = primitive.joints[i];
        const glm::vec4& w = primitive.weights[i];
        const float sum = w.x + w.y + w.z + w.w;
        v.weights = sum > 0.0f ? w / sum : glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
    }
    return vertices;
}

std::vector<MorphDelta> morph_deltas(const asset::Primitive& primitive) {
    const size_t count = primitive.positions.size();
    std::vector<MorphDelta> deltas(count * primitive.morph_targets.size());
    for (size_t t = 0; t < primitive.morph_targets.size(); ++t) {
        const asset::MorphTarget& target = primitive.morph_targets[t];
        for (size_t i = 0; i < count; ++i) {
            MorphDelta& delta = deltas[t * count + i];
            if (i < target.positions.size()) delta.position = target.positions[i];
            if (i < target.normals.size()) delta.normal = target.normals[i];
        }
    }
    return deltas;
}

template <class T>
Result<void> upload_column(gpu::Device& device, const std::vector<T>& values, const char* name,
                           gpu::Buffer& out) {
    if (values.empty()) return {};
    auto buffer = gpu::Buffer::upload_span(device, std::span<const T>(values), name);
    if (!buffer) return buffer.error();
    out = *std::move(buffer);
    return {};
}

Result<gpu::Image> upload_image(gpu::Device& device, const asset::Image& image, const char* name) {
    return gpu::Image::upload(
        device, {.format = gpu::Format::kRgba8Srgb, .width = image.width, .height = image.height},
        std::as_bytes(std::span(image.rgba)), name);
}

Result<AssetMeshes> upload_asset(gpu::Device& device, const asset::SceneAsset& scene) {
    AssetMeshes result;
    result.images.resize(scene.images.size());
    for (const asset::Material& material : scene.materials) {
        const uint32_t index = material.base_color_image;
        if (index >= scene.images.size() || result.images[index]) continue;
        if (scene.images[index].rgba.empty()) continue;
        auto image = upload_image(device, scene.images[index], "base colour image");
        if (!image) return image.error();
        result.images[index] = *std::move(image);
    }
    for (const asset::Mesh& mesh : scene.meshes) {
        auto& primitives = result.meshes.emplace_back();
        for (const asset::Primitive& primitive : mesh.primitives) {
            if (primitive.topology != asset::Topology::kTriangles || primitive.indices.empty()) {
                continue;
            }
            auto buffers = MeshBuffers::upload(device, primitive);
            if (!buffers) return buffers.error();
            primitives.push_back(*std::move(buffers));
        }
    }
    return result;
}

gpu::RasterInfo shadow_info() {
    gpu::RasterInfo info;
    info.vertex_shader = "character/shadow.vert.glsl";
    info.push_bytes = sizeof(ShadowPush);
    info.depth_format = gpu::Format::kD32Float;
    info.depth = gpu::DepthMode::kTestWrite;
    return info;
}

Result<MeshPipelines> make_pipelines(gpu::Device& device) {
    gpu::PipelineLibrary& library = device.pipelines();
    const auto skin = library.compute(skin_info(false));
    if (!skin) return skin.error();
    const auto shadow = library.raster(shadow_info());
    if (!shadow) return shadow.error();
    return MeshPipelines{.skin = *skin, .shadow = *shadow};
}

}  // namespace

gpu::ComputeInfo skin_info(bool covered) {
    return {.shader = "character/skin.comp.glsl",
            .push_bytes = sizeof(SkinPush),
            .constants = {covered ? 1U : 0U}};
}

gpu::RasterInfo draw_info(uint32_t lights, HairOnMeshes hair, bool covered, bool cull_back) {
    gpu::RasterInfo info;
    info.vertex_shader = "character/mesh.vert.glsl";
    info.fragment_shader = "character/mesh.frag.glsl";
    info.bindings = {gpu::Binding::kSampledRepeat, gpu::Binding::kSampledNearest,
                     gpu::Binding::kUniform, gpu::Binding::kUniform};
    info.push_bytes = sizeof(MeshPush);
    info.constants = {lights, static_cast<uint32_t>(hair), covered ? 1U : 0U};
    info.color_formats = {gpu::Format::kRgba16Float, gpu::Format::kRg16Float};
    info.depth_format = gpu::Format::kD32Float;
    info.depth = gpu::DepthMode::kTestWrite;
    info.cull_back = cull_back;
    return info;
}

Result<MeshBuffers> MeshBuffers::upload(gpu::Device& device, const asset::Primitive& primitive) {
    MeshBuffers result;
    result.vertex_count = static_cast<uint32_t>(primitive.positions.size());
    result.index_count = static_cast<uint32_t>(primitive.indices.size());
    result.target_count = static_cast<uint32_t>(primitive.morph_targets.size());
    result.has_joints = !primitive.joints.empty() && !primitive.weights.empty();
    result.material = primitive.material;
    if (auto ok = upload_column(device, rest_vertices(primitive), "mesh vertices", result.vertices);
        !ok) {
        return ok.error();
    }
    if (auto ok = upload_column(device, morph_deltas(primitive), "morph targets", result.morphs);
        !ok) {
        return ok.error();
    }
    if (auto ok = upload_column(device, primitive.texcoords, "mesh texcoords", result.texcoords);
        !ok) {
        return ok.error();
    }
    if (auto ok = upload_column(device, primitive.colors, "mesh colours", result.colors); !ok) {
        return ok.error();
    }
    if (auto ok = upload_column(device, primitive.indices, "mesh indices", result.indices); !ok) {
        return ok.error();
    }
    return result;
}

uint64_t MeshBuffers::bytes() const {
    return vertices.bytes() + morphs.bytes() + texcoords.bytes() + colors.bytes() + indices.bytes();
}

Result<void> MeshLibrary::update(gpu::Device& device, const scene::SceneLibrary& library) {
    if (pipelines.skin == nullptr && library.assets.size() > assets.size()) {
        auto made = make_pipelines(device);
        if (!made) return made.error();
        auto texel = upload_image(device, {1, 1, {255, 255, 255, 255}}, "white texel");
        if (!texel) return texel.error();
        white = *std::move(texel);
        pipelines = *made;
    }
    while (assets.size() < library.assets.size()) {
        const asset::SceneAsset& scene = *library.assets[assets.size()];
        auto uploaded = upload_asset(device, scene);
        if (!uploaded) {
            Error error = uploaded.error();
            error.where = fmt::format("{}: {}", scene.path.string(), error.where);
            return error;
        }
        assets.push_back(*std::move(uploaded));
    }
    return {};
}

uint64_t MeshLibrary::bytes() const {
    uint64_t total = white.bytes();
    for (const AssetMeshes& asset : assets) {
        for (const gpu::Image& image : asset.images) total += image.bytes();
        for (const auto& mesh : asset.meshes) {
            for (const MeshBuffers& primitive : mesh) total += primitive.bytes();
        }
    }
    return total;
}

}  // namespace vellus::character
