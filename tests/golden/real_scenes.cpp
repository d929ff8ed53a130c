#include "tests/golden/real_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "engine/asset/gltf.h"
#include "engine/platform/files.h"
#include "modules/hair/binding/rest_mesh.h"
#include "modules/hair/groom/groom_file.h"
#include "tests/golden/picture.h"
#include "tests/support/fur.h"

namespace vellus::test {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path scene_with_hair(const std::string& name, const fs::path& glb, const std::string& node,
                         json hair, const std::function<void(json&)>& edit) {
    const fs::path folder = work_folder() / "scenes";
    fs::create_directories(folder);
    auto bytes = read_file(glb);
    if (!bytes) return {};
    // GLB: 12 bytes of header, then a chunk of JSON and one of binary, 8 bytes of header each.
    uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, bytes->data() + 12, 4);
    const auto* text = reinterpret_cast<const char*>(bytes->data() + 20);
    json scene = json::parse(text, text + json_bytes);
    const size_t binary = 20 + json_bytes + 8;
    scene["buffers"][0] = {{"uri", fs::relative(glb, folder).string()},
                           {"byteLength", bytes->size()}};
    for (auto& view : scene["bufferViews"]) {
        view["byteOffset"] = view.value("byteOffset", size_t{0}) + binary;
    }
    hair["groom"] = fs::relative(hair["groom"].get<std::string>(), folder).string();
    for (auto& item : scene["nodes"]) {
        if (item.value("name", "") == node) item["extensions"]["VELLUS_hair"] = hair;
    }
    scene["extensionsUsed"].push_back("VELLUS_hair");
    if (edit) edit(scene);
    fs::path path = folder / (name + ".gltf");
    if (!write_file(path, std::string_view(scene.dump()))) return {};
    return path;
}

void scale_scene(json& scene, double scale) {
    auto& roots = scene["scenes"][scene.value("scene", 0)]["nodes"];
    const json above = {{"name", "scale"}, {"scale", {scale, scale, scale}}, {"children", roots}};
    roots = json::array({scene["nodes"].size()});
    scene["nodes"].push_back(above);
}

void keep_animation(json& scene, const std::string& name) {
    const auto others = [&](const json& item) { return item.value("name", "") != name; };
    auto& all = scene["animations"];
    all.erase(std::remove_if(all.begin(), all.end(), others), all.end());
}

fs::path write_fur(const std::string& name, const fs::path& glb, const std::string& node,
                   size_t strands, double length) {
    const auto scene = asset::load_gltf(glb);
    EXPECT_TRUE(scene);
    if (!scene) return {};
    const auto found = std::ranges::find(scene->nodes, node, &asset::Node::name);
    const auto mesh = hair::rest_mesh(*scene, static_cast<uint32_t>(found - scene->nodes.begin()));
    EXPECT_TRUE(mesh);
    if (!mesh) return {};
    const Fur fur = grow_fur(mesh->positions, mesh->triangles, strands, length, 8);
    fs::path path = work_folder() / "scenes" / (name + ".glb");
    fs::create_directories(path.parent_path());
    const auto bytes = hair::write_glb(fur.groom);
    EXPECT_TRUE(bytes);
    EXPECT_TRUE(bytes && write_file(path, std::span<const std::byte>(*bytes)));
    return path;
}

}  // namespace vellus::test
