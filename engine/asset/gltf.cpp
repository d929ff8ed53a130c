#include "engine/asset/gltf.h"

#include "engine/asset/gltf_context.h"
#include "engine/platform/files.h"

namespace vellus::asset {
namespace detail {

void refuse(std::string pointer, std::string what, std::string remedy) {
    throw Refusal{{std::move(what), std::move(pointer), std::move(remedy)}};
}

void Context::warn(const std::string& pointer, const std::string& text) {
    constexpr size_t kMaxWarnings = 100;
    if (warnings.size() < kMaxWarnings) {
        warnings.push_back(pointer.empty() ? text : fmt::format("{}: {}", pointer, text));
    } else if (warnings.size() == kMaxWarnings) {
        warnings.emplace_back("further warnings left out");
    }
}

void Context::charge(uint64_t count, uint64_t bytes_each, const std::string& pointer) {
    const uint64_t allowed = limits.fixed_bytes + limits.multiple * bytes_read;
    if (count > (allowed - bytes_built) / bytes_each) {
        refuse(pointer,
               fmt::format(
                   "{} elements make the scene need more than {} bytes, {} times its files plus {}",
                   count, allowed, limits.multiple, limits.fixed_bytes),
               "the file is broken or repeats its data too often: split it up");
    }
    bytes_built += count * bytes_each;
}

namespace {

/// Takes the indices out of every primitive: tinygltf refuses legal ones (of an accessor without
/// buffer view).
std::vector<std::vector<int>> take_indices(Json& doc) {
    std::vector<std::vector<int>> indices;
    const auto meshes = doc.find("meshes");
    if (meshes == doc.end()) {
        return indices;
    }
    for (Json& mesh : *meshes) {
        indices.emplace_back();
        for (Json& primitive : mesh["primitives"]) {
            indices.back().push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    }
    return indices;
}

/// Gives tinygltf the document without buffers and images, which it would load itself.
void parse_model(Context& context) {
    Json doc = context.doc;
    doc.erase("buffers");
    doc.erase("images");
    const auto indices = take_indices(doc);
    const std::string text = doc.dump();
    tinygltf::TinyGLTF loader;
    std::string errors;
    std::string warnings;
    if (!loader.LoadASCIIFromString(&context.model, &errors, &warnings, text.data(),
                                    static_cast<unsigned>(text.size()), "")) {
        refuse("", fmt::format("tinygltf: {}", errors.substr(0, errors.find('\n'))),
               "export it again");
    }
    for (size_t m = 0; m < indices.size(); ++m) {
        for (size_t p = 0; p < indices[m].size(); ++p) {
            context.model.meshes.at(m).primitives.at(p).indices = indices[m][p];
        }
    }
}

SceneAsset read_scene(Bytes file, Context& context) {
    context.bytes_read = file.size();
    const Container container = open_container(file, context);
    if (container.json.size() > std::numeric_limits<uint32_t>::max() / 2) {
        refuse("", "2 GiB of JSON or more", "store buffers and images in binary");
    }
    context.doc = parse_json(container.json, context);
    check_schema(context.doc, context);
    read_buffers(container.bin, context);
    parse_model(context);
    check_accessors(context);
    SceneAsset scene;
    read_images(context, scene);
    read_materials(context, scene);
    read_meshes(context, scene);
    read_skins(context, scene);
    read_cameras_and_lights(context, scene);
    read_nodes(context, scene);
    check_skinned_nodes(context, scene);
    read_animations(context, scene);
    scene.warnings = std::move(context.warnings);
    return scene;
}

}  // namespace
}  // namespace detail

Result<SceneAsset> load_gltf_bytes(std::span<const std::byte> bytes,
                                   const std::filesystem::path& base_dir,
                                   const GltfLimits& limits) {
    detail::Context context{.limits = limits, .base_dir = base_dir};
    try {
        return detail::read_scene(bytes, context);
    } catch (detail::Refusal& refusal) {
        return std::move(refusal.error);
    } catch (const std::exception& e) {
        return Error{fmt::format("cannot be read: {}", e.what()), "", "export it again"};
    }
}

Result<SceneAsset> load_gltf(const std::filesystem::path& path, const GltfLimits& limits) {
    const auto bytes = read_file(path);
    if (!bytes) {
        return bytes.error();
    }
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    Result<SceneAsset> scene = load_gltf_bytes(*bytes, folder, limits);
    if (!scene) {
        const Error& e = scene.error();
        return Error{e.what,
                     e.where.empty() ? path.string() : fmt::format("{} {}", path.string(), e.where),
                     e.remedy};
    }
    scene->path = path;
    return scene;
}

}  // namespace vellus::asset
