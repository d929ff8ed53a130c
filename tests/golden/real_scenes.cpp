#include "tests/golden/real_scenes.h"

#include <cstring>
#include <fstream>

#include "engine/platform/files.h"

namespace vellus::test {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path scene_with_hair(const std::string& name, const fs::path& glb, const std::string& node,
                         json hair) {
    const fs::path folder = fs::path(VELLUS_BINARY_DIR) / "golden" / "scenes";
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
    const fs::path path = folder / (name + ".gltf");
    if (!write_file(path, std::string_view(scene.dump()))) return {};
    return path;
}

}  // namespace vellus::test
