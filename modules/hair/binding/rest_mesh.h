#pragma once

#include <vector>

#include "engine/asset/scene_asset.h"
#include "modules/hair/binding/bound_roots.h"

namespace vellus::hair {

/// The triangles of a mesh as it rests, and what bends them: where a groom is bound.
struct RestMesh {
    std::vector<glm::dvec3> positions;  ///< morphed and skinned, in the rest space
    std::vector<glm::dvec3> normals;    ///< smooth, as long as the map leaves them
    std::vector<glm::uvec3> triangles;
    std::vector<BoundVertex> vertices;  ///< the same vertices as the file has them
    std::vector<BoundMorph> morphs;     ///< target by target
    uint32_t target_count = 0;
    uint32_t joint_count = 1;
};

/// All triangle primitives of a mesh in the pose given: `palette` maps mesh space to the rest space
/// (one entry for a mesh without skin), `weights` are those of its morph targets. Errors name the
/// mesh where it has no triangles or a joint is out of range.
Result<RestMesh> rest_mesh(const asset::Mesh& mesh, std::span<const glm::dmat4> palette,
                           std::span<const float> weights);

/// World matrix of each node below the roots with the transforms of the file, relative to the
/// instance's root.
std::vector<glm::dmat4> rest_transforms(const asset::SceneAsset& scene);

/// By joint of the node's skin (one entry without skin): mesh space to the rest space.
std::vector<glm::dmat4> rest_palette(const asset::SceneAsset& scene, uint32_t node);

/// The mesh of a node as its file has it before any animation: what one sees opening the scene.
/// The rest space is that of the instance's root. Errors name file and node.
Result<RestMesh> rest_mesh(const asset::SceneAsset& scene, uint32_t node);

}  // namespace vellus::hair
