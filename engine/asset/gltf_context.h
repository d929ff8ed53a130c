#pragma once

#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "engine/asset/gltf.h"
#include "engine/asset/gltf_tiny.h"

// What the stages of the glTF reader share. Inside it a file is refused by an exception, which
// gltf.cpp turns into an Error; places in the file are JSON pointers such as
// /meshes/0/primitives/2/indices.
namespace vellus::asset::detail {

using Json = nlohmann::json;
using Bytes = std::span<const std::byte>;

struct Refusal {
    Error error;
};

/// Ends the reading: `pointer` says where, `remedy` what the user can do.
[[noreturn]] void refuse(std::string pointer, std::string what, std::string remedy);

/// The file as it was cut up and checked, and what is left of its allowance.
struct Context {
    GltfLimits limits;
    std::filesystem::path base_dir;
    Json doc;
    tinygltf::Model model;
    /// Bytes of each buffer; nothing where the file gives none.
    std::vector<std::optional<Bytes>> buffers;
    std::deque<std::vector<std::byte>> storage;
    uint64_t bytes_read = 0;
    uint64_t bytes_built = 0;
    uint64_t pixels_built = 0;
    std::vector<std::string> warnings;

    void warn(const std::string& pointer, const std::string& text);

    /// Books memory about to be allocated; refuses the file where it exceeds GltfLimits.
    void charge(uint64_t count, uint64_t bytes_each, const std::string& pointer);
};

/// GLB cut into its JSON and BIN chunks, or all of a .gltf as JSON.
struct Container {
    std::string_view json;
    std::optional<Bytes> bin;
};
Container open_container(Bytes file, Context& context);

/// A member of an object, or null (which iterates as empty).
const Json& member(const Json& object, const char* name);

/// JSON text to a document of bounded depth.
Json parse_json(std::string_view text, Context& context);

/// Checks every property the engine reads: presence, type, range, length, and that indices point at
/// something. Integers written as 1.0 become integers; material factors are clamped. Also the
/// version and the extensions.
void check_schema(Json& doc, Context& context);

/// Reads what a URI refers to: a data URI, or a file relative to the scene's folder.
Bytes read_uri(const std::string& uri, const std::string& pointer, Context& context);

/// Fills context.buffers from `buffers` of the document.
void read_buffers(const std::optional<Bytes>& bin, Context& context);

/// A buffer view's bytes, in bounds.
Bytes buffer_view(const Context& context, size_t view, const std::string& pointer);

/// Checks every buffer view and accessor against the bytes it refers to.
void check_accessors(Context& context);

/// Elements of an accessor as floats, `components` each (normalized integers scaled as the
/// specification says, sparse values put in); every value is finite. Refuses another element type.
std::vector<float> read_floats(Context& context, int accessor, int components,
                               const std::string& pointer);

/// Elements of an unsigned integer accessor, `components` each.
std::vector<uint32_t> read_unsigned(Context& context, int accessor, int components,
                                    const std::string& pointer);

size_t accessor_count(const Context& context, int accessor);

/// "VEC3 of float"-like facts about an accessor.
int accessor_components(const Context& context, int accessor);
bool accessor_is_float(const Context& context, int accessor);

void read_images(Context& context, SceneAsset& scene);
void read_materials(Context& context, SceneAsset& scene);
void read_meshes(Context& context, SceneAsset& scene);
void read_skins(Context& context, SceneAsset& scene);
void read_cameras_and_lights(Context& context, SceneAsset& scene);
void read_nodes(Context& context, SceneAsset& scene);
void read_animations(Context& context, SceneAsset& scene);

/// Joins and attributes of skinned meshes fit the skins of the nodes that use them.
void check_skinned_nodes(Context& context, const SceneAsset& scene);

inline uint32_t to_index(int index) {
    return index < 0 ? kNone : static_cast<uint32_t>(index);
}

}  // namespace vellus::asset::detail
