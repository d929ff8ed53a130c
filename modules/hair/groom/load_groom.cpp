#include <algorithm>
#include <array>
#include <cstring>

#include "engine/asset/gltf.h"
#include "engine/platform/files.h"
#include "modules/hair/groom/byte_io.h"
#include "modules/hair/groom/groom_file.h"

namespace vellus::hair {

namespace {

bool begins_with(std::span<const std::byte> bytes, std::string_view text) {
    return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

/// A binary glTF, or JSON text: its first character that is no space (or byte-order mark) is '{'.
bool looks_like_gltf(std::span<const std::byte> bytes) {
    if (begins_with(bytes, "glTF")) return true;
    if (begins_with(bytes, "\xEF\xBB\xBF")) bytes = bytes.subspan(3);
    const auto first = std::ranges::find_if_not(bytes, [](std::byte byte) {
        return std::string_view(" \t\r\n").find(static_cast<char>(byte)) != std::string_view::npos;
    });
    return first != bytes.end() && *first == std::byte{'{'};
}

bool looks_like_tfx(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(float)) return false;
    const auto version = copy_value<float>(bytes, 0);
    return version >= 3.0f && version < 5.0f;
}

Result<Groom> read_any(std::span<const std::byte> bytes, const std::filesystem::path& path) {
    const std::string where = path.string();
    if (begins_with(bytes, "HAIR")) return read_hair(bytes, where);
    if (looks_like_tfx(bytes)) return read_tfx(bytes, where);
    if (looks_like_gltf(bytes)) {
        auto scene = asset::load_gltf(path);
        if (!scene) return scene.error();
        return groom_from_scene(*scene, where);
    }
    return Error{"is no groom", where, "give a .hair, a .tfx 3.x or 4.x, or a glTF of line strips"};
}

}  // namespace

Result<LoadedGroom> load_groom(const std::filesystem::path& path) {
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    auto groom = read_any(*bytes, path);
    if (!groom) return groom.error();
    LoadedGroom loaded{std::move(*groom), {}};
    loaded.report = repair(loaded.groom);
    return loaded;
}

Result<void> save_groom(const Groom& groom, const std::filesystem::path& path) {
    struct Writer {
        std::string_view extension;
        Result<std::vector<std::byte>> (*write)(const Groom&);
    };
    constexpr std::array<Writer, 3> kWriters = {
        {{".hair", write_hair}, {".tfx", write_tfx}, {".glb", write_glb}}};
    for (const Writer& writer : kWriters) {
        if (path.extension() != writer.extension) continue;
        auto bytes = writer.write(groom);
        if (!bytes) return Error{bytes.error().what, path.string(), bytes.error().remedy};
        return write_file(path, *bytes);
    }
    return Error{fmt::format("cannot write a groom as '{}'", path.extension().string()),
                 path.string(), "name it .hair, .tfx or .glb"};
}

}  // namespace vellus::hair
