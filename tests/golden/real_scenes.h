#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace vellus::test {

/// Writes a .gltf that shows a .glb with hair on one of its nodes: the binary file itself serves as
/// the buffer, nothing is copied. `hair` is the VELLUS_hair object, its groom an absolute path;
/// `edit` may change the rest of the scene. Returns the scene's path.
std::filesystem::path scene_with_hair(const std::string& name, const std::filesystem::path& glb,
                                      const std::string& node, nlohmann::json hair,
                                      const std::function<void(nlohmann::json&)>& edit = {});

/// The scene's nodes below a new one that scales them.
void scale_scene(nlohmann::json& scene, double scale);
/// Only the animation of this name stays, so that it is the one played.
void keep_animation(nlohmann::json& scene, const std::string& name);

/// Writes fur that covers the mesh of a file's node as the file opens, as line strips in the units
/// of the file; returns the groom's path.
std::filesystem::path write_fur(const std::string& name, const std::filesystem::path& glb,
                                const std::string& node, size_t strands, double length);

}  // namespace vellus::test
