#include <iterator>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "modules/hair/cards/card_file.h"
#include "modules/hair/groom/byte_io.h"

namespace vellus::hair {

namespace {

/// An image of the atlas: `texel(i)` gives RGB and alpha of texel i.
template <class Texel>
asset::Image picture(const CardAtlas& atlas, const Texel& texel) {
    asset::Image image{.width = atlas.width, .height = atlas.height, .rgba = {}};
    image.rgba.reserve(4 * atlas.texels());
    for (size_t i = 0; i < atlas.texels(); ++i) {
        const glm::u8vec4 value = texel(i);
        for (int c = 0; c < 4; ++c) image.rgba.push_back(value[c]);
    }
    return image;
}

Result<void> save_maps(const CardAtlas& atlas, const std::filesystem::path& folder,
                       const std::string& name) {
    const auto save = [&](const char* map, const auto& texel) {
        return asset::save_png(folder / fmt::format("{}_{}.png", name, map), picture(atlas, texel));
    };
    const Result<void> steps[] = {
        save("color",
             [&](size_t i) {
                 const glm::u8vec3 color = atlas.color.empty() ? glm::u8vec3(255) : atlas.color[i];
                 return glm::u8vec4(color, atlas.opacity[i]);
             }),
        save("tangent", [&](size_t i) { return glm::u8vec4(atlas.tangent[i], 255); }),
        save("depth", [&](size_t i) { return glm::u8vec4(glm::u8vec3(atlas.depth[i]), 255); }),
        atlas.parameter.empty()
            ? Result<void>()
            : save("root",
                   [&](size_t i) { return glm::u8vec4(glm::u8vec3(atlas.parameter[i]), 255); }),
        atlas.strand.empty()
            ? Result<void>()
            : save("strand",
                   [&](size_t i) {
                       return glm::u8vec4(atlas.strand[i] >> 8U, atlas.strand[i] & 0xffU, 0, 255);
                   }),
        atlas.fibres.empty()
            ? Result<void>()
            : save("fibres",
                   [&](size_t i) { return glm::u8vec4(glm::u8vec3(atlas.fibres[i]), 255); }),
    };
    for (const auto& step : steps) {
        if (!step) return step;
    }
    return {};
}

/// Unit normals out of the cards, for other programs; a viewer lights cards with them.
std::vector<glm::vec3> normals_of(const CardGroom& cards) {
    std::vector<glm::vec3> normals(cards.points.size(), glm::vec3(0.0f));
    for (const glm::uvec3& t : cards.triangles) {
        const glm::vec3 a = cards.points[t.x];
        const glm::vec3 normal = glm::cross(cards.points[t.y] - a, cards.points[t.z] - a);
        for (int i = 0; i < 3; ++i) normals[t[i]] += normal;
    }
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        normal = length > 1e-20f ? normal / length : glm::vec3(0, 1, 0);
    }
    return normals;
}

std::string color_array(glm::vec3 color, const char* end) {
    return fmt::format("[{},{},{}{}", color.x, color.y, color.z, end);
}

std::string gltf_json(const CardGroom& cards, const std::string& name, size_t bin_bytes) {
    Bounds box;
    for (const glm::vec3& p : cards.points) box.add(p);
    const size_t points = cards.points.size();
    const size_t indices = 3 * cards.triangles.size();
    std::string out;
    fmt::format_to(
        std::back_inserter(out),
        R"({{"asset":{{"version":"2.0","generator":"Vellus"}},"extensionsUsed":["{}"],)"
        R"("scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"{}","mesh":0,)"
        R"("extensions":{{"{}":{{"ribbons":{},"colored":{},"depth_range":{},)"
        R"({}"tangent":"{}_tangent.png","depth":"{}_depth.png"{}{}{}}}}}}}],)",
        kCardsExtensionName, name, kCardsExtensionName, cards.ribbons, !cards.atlas.color.empty(),
        cards.depth_range, cards.color ? R"("color":)" + color_array(*cards.color, "]") + "," : "",
        name, name,
        cards.atlas.parameter.empty() ? "" : fmt::format(R"(,"root":"{}_root.png")", name),
        cards.atlas.strand.empty() ? "" : fmt::format(R"(,"strand":"{}_strand.png")", name),
        cards.atlas.fibres.empty() ? "" : fmt::format(R"(,"fibres":"{}_fibres.png")", name));
    fmt::format_to(
        std::back_inserter(out),
        R"("images":[{{"uri":"{}_color.png"}}],"samplers":[{{}}],)"
        R"("textures":[{{"source":0,"sampler":0}}],)"
        R"("materials":[{{"alphaMode":"MASK","alphaCutoff":0.3,"doubleSided":true,)"
        R"("pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0.6,)"
        R"({}"baseColorTexture":{{"index":0}}}}}}],)"
        R"("meshes":[{{"primitives":[{{"mode":4,"material":0,"indices":3,)"
        R"("attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}}}]}}],)",
        name, cards.color ? R"("baseColorFactor":)" + color_array(*cards.color, ",1]") + "," : "");
    fmt::format_to(std::back_inserter(out),
                   R"("buffers":[{{"uri":"{}.bin","byteLength":{}}}],"bufferViews":[)"
                   R"({{"buffer":0,"byteOffset":0,"byteLength":{}}},)"
                   R"({{"buffer":0,"byteOffset":{},"byteLength":{}}},)"
                   R"({{"buffer":0,"byteOffset":{},"byteLength":{}}},)"
                   R"({{"buffer":0,"byteOffset":{},"byteLength":{}}}],)",
                   name, bin_bytes, 12 * points, 12 * points, 12 * points, 24 * points, 8 * points,
                   32 * points, 4 * indices);
    fmt::format_to(std::back_inserter(out),
                   R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3",)"
                   R"("min":[{},{},{}],"max":[{},{},{}]}},)"
                   R"({{"bufferView":1,"componentType":5126,"count":{},"type":"VEC3"}},)"
                   R"({{"bufferView":2,"componentType":5126,"count":{},"type":"VEC2"}},)"
                   R"({{"bufferView":3,"componentType":5125,"count":{},"type":"SCALAR"}}]}})",
                   points, box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z,
                   points, points, indices);
    return out;
}

/// Names go into JSON and file names as they are.
bool plain(const std::string& name) {
    return !name.empty() && name.find_first_of("\"\\%/") == std::string::npos;
}

}  // namespace

Result<void> save_cards(const CardGroom& cards, const std::filesystem::path& path) {
    const std::string name = path.stem().string();
    if (path.extension() != ".gltf" || !plain(name)) {
        return Error{"cannot write cards under this name", path.string(),
                     "name it .gltf, without quotes, backslashes or percent signs"};
    }
    if (cards.triangles.empty()) {
        return Error{"no cards to write", path.string(), "build or load some first"};
    }
    std::vector<std::byte> bin;
    const std::vector<glm::vec3> normals = normals_of(cards);
    append_values(bin, std::span<const glm::vec3>(cards.points));
    append_values(bin, std::span<const glm::vec3>(normals));
    append_values(bin, std::span<const glm::vec2>(cards.uvs));
    append_values(bin, std::span<const glm::uvec3>(cards.triangles));
    const std::filesystem::path folder = path.parent_path();
    if (auto maps = save_maps(cards.atlas, folder, name); !maps) return maps;
    if (auto written = write_file(folder / (name + ".bin"), bin); !written) return written;
    return write_file(path, gltf_json(cards, name, bin.size()));
}

}  // namespace vellus::hair
