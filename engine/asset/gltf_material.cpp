#include <algorithm>

#include "engine/asset/gltf_context.h"
#include "engine/asset/image_io.h"

namespace vellus::asset::detail {
namespace {

Bytes image_bytes(const Json& image, const std::string& pointer, Context& context) {
    const bool has_uri = image.contains("uri");
    const bool has_view = image.contains("bufferView");
    if (has_uri == has_view) {
        refuse(pointer, has_uri ? "both uri and bufferView" : "neither uri nor bufferView",
               "export it again");
    }
    if (has_uri) {
        return read_uri(image["uri"].get<std::string>(), pointer + "/uri", context);
    }
    if (!image.contains("mimeType")) {
        context.warn(pointer + "/mimeType", "missing; told by content");
    }
    return buffer_view(context, image["bufferView"].get<size_t>(), pointer + "/bufferView");
}

/// Empty where it cannot be read: a scene is of use without one of its textures.
Image read_image(const Json& from, const std::string& pointer, Context& context) {
    try {
        const uint64_t allowed = context.limits.image_pixels - context.pixels_built;
        Result<Image> image =
            decode_image(image_bytes(from, pointer, context), std::min(allowed, kMaxImagePixels));
        if (image) {
            context.pixels_built += uint64_t{image->width} * image->height;
            return std::move(*image);
        }
        context.warn(pointer, image.error().message());
    } catch (const Refusal& refusal) {
        context.warn(refusal.error.where,
                     fmt::format("{} ({})", refusal.error.what, refusal.error.remedy));
    }
    return {};
}

/// The image a texture shows, or kNone where the reader could not decode it.
uint32_t usable_image(int texture, const std::string& pointer, Context& context,
                      const SceneAsset& scene) {
    if (texture < 0) {
        return kNone;
    }
    const int source = context.model.textures[static_cast<size_t>(texture)].source;
    if (source >= 0 && !scene.images[static_cast<size_t>(source)].rgba.empty()) {
        return static_cast<uint32_t>(source);
    }
    context.warn(pointer,
                 fmt::format("texture {} has no image this engine can show; left out", texture));
    return kNone;
}

template <class TextureInfo>
uint32_t texture_image(const TextureInfo& info, const std::string& pointer, Context& context,
                       const SceneAsset& scene) {
    if (info.index >= 0 && info.texCoord != 0) {
        context.warn(pointer + "/texCoord", "only TEXCOORD_0 is read; used instead");
    }
    return usable_image(info.index, pointer, context, scene);
}

AlphaMode alpha_mode(const std::string& name, const std::string& pointer, Context& context) {
    if (name == "MASK") {
        return AlphaMode::kMask;
    }
    if (name == "BLEND") {
        return AlphaMode::kBlend;
    }
    if (!name.empty() && name != "OPAQUE") {
        context.warn(pointer + "/alphaMode",
                     fmt::format("unknown mode '{}' read as OPAQUE", name.substr(0, 40)));
    }
    return AlphaMode::kOpaque;
}

/// KHR_materials_emissive_strength: a factor for emissiveFactor; negative ones are refused.
float emissive_strength(const tinygltf::Material& material, const std::string& pointer) {
    const auto found = material.extensions.find("KHR_materials_emissive_strength");
    if (found == material.extensions.end() || !found->second.Has("emissiveStrength")) {
        return 1.0f;
    }
    const tinygltf::Value& value = found->second.Get("emissiveStrength");
    const double strength = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
    if (!(strength >= 0.0 && strength <= 1e30)) {
        refuse(pointer + "/extensions/KHR_materials_emissive_strength/emissiveStrength",
               "no number >= 0", "correct the file");
    }
    return static_cast<float>(strength);
}

Material read_material(const tinygltf::Material& from, const std::string& pointer, Context& context,
                       const SceneAsset& scene) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    const auto& color = pbr.baseColorFactor;
    const auto& emissive = from.emissiveFactor;
    Material material;
    material.name = from.name;
    material.base_color = glm::vec4(color[0], color[1], color[2], color[3]);
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.emissive =
        glm::vec3(emissive[0], emissive[1], emissive[2]) * emissive_strength(from, pointer);
    material.emissive = glm::min(material.emissive, glm::vec3(std::numeric_limits<float>::max()));
    const std::string inner = pointer + "/pbrMetallicRoughness";
    material.base_color_image =
        texture_image(pbr.baseColorTexture, inner + "/baseColorTexture", context, scene);
    material.metallic_roughness_image = texture_image(
        pbr.metallicRoughnessTexture, inner + "/metallicRoughnessTexture", context, scene);
    material.normal_image =
        texture_image(from.normalTexture, pointer + "/normalTexture", context, scene);
    material.alpha_mode = alpha_mode(from.alphaMode, pointer, context);
    material.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    material.double_sided = from.doubleSided;
    return material;
}

}  // namespace

void read_images(Context& context, SceneAsset& scene) {
    const Json& images = member(context.doc, "images");
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string pointer = fmt::format("/images/{}", i);
        scene.images.push_back(read_image(images[i], pointer, context));
    }
}

void read_materials(Context& context, SceneAsset& scene) {
    for (size_t i = 0; i < context.model.materials.size(); ++i) {
        scene.materials.push_back(read_material(context.model.materials[i],
                                                fmt::format("/materials/{}", i), context, scene));
    }
}

}  // namespace vellus::asset::detail
