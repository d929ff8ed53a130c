#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace vellus::test {

/// Writes a .gltf that shows a .glb with hair on one of its nodes: the binary file itself serves as
/// the buffer, nothing is copied. `hair` is the VELLUS_hair object, its groom an absolute path.
/// Returns the scene's path.
std::filesystem::path scene_with_hair(const std::string& name, const std::filesystem::path& glb,
                                      const std::string& node, nlohmann::json hair);

}  // namespace vellus::test
