#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/asset/scene_asset.h"
#include "engine/platform/result.h"
#include "modules/hair/groom/groom.h"
#include "modules/hair/groom/groom_report.h"

namespace vellus::hair {

/// A groom ready for use (defects repaired as the report says), and what was found on the way.
struct LoadedGroom {
    Groom groom;
    GroomReport report;
};

/// Reads .hair, .tfx 3.x, .tfx 4.x or glTF line strips, told apart by content; never by the name
/// alone. Any bytes end in a groom or an Error.
Result<LoadedGroom> load_groom(const std::filesystem::path& path);

// Readers, one per format: the file as it is, defects included. `where` names the source in errors.
Result<Groom> read_hair(std::span<const std::byte> bytes, const std::string& where);
Result<Groom> read_tfx(std::span<const std::byte> bytes, const std::string& where);
/// Every line strip (or line list) of the scene is one strand, in the space of its mesh.
Result<Groom> groom_from_scene(const asset::SceneAsset& scene, const std::string& where);

// Writers: bytes that the readers above turn into the same columns again, or an Error that names
// what the format cannot hold.
Result<std::vector<std::byte>> write_hair(const Groom& groom);
/// TressFX 4.0; all strands need the same number of points.
Result<std::vector<std::byte>> write_tfx(const Groom& groom);
/// A binary glTF with one mesh of line strips.
Result<std::vector<std::byte>> write_glb(const Groom& groom);

/// Writes atomically in the format the extension names: .hair, .tfx or .glb.
Result<void> save_groom(const Groom& groom, const std::filesystem::path& path);

}  // namespace vellus::hair
