#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/asset/scene_asset.h"
#include "engine/platform/result.h"
#include "modules/hair/grow/surface.h"

namespace vellus::hair {

/// Which part of a scene's meshes is haired; what is given holds together (where all of them say
/// so, hair grows).
struct RegionChoice {
    /// Name of a node or a mesh; empty: all of them. The others are still in the hair's way.
    std::string mesh;
    /// Name of a vertex attribute ("_SCALP", "COLOR_0.r" to ".a", "COLOR_1"), or of a joint: its
    /// share in each vertex.
    std::string group;
    /// Picture over TEXCOORD_0, white where hair grows.
    std::filesystem::path mask;
    /// Middle and radius of a ball, in the scene.
    std::optional<glm::vec4> sphere;
};

/// The triangle meshes of a scene in its rest pose (nodes and skins applied, no animation, no morph
/// target), as a body for grow_groom(). An Error names what the scene lacks and what it has.
Result<GrowSurface> surface_from_scene(const asset::SceneAsset& scene, const RegionChoice& choice);

/// Where a node of that name stands in the rest pose; an Error that lists the names.
Result<glm::dmat4> rest_transform(const asset::SceneAsset& scene, const std::string& node);

}  // namespace vellus::hair
