#pragma once

#include <cstddef>
#include <vector>

#include "engine/asset/scene_asset.h"

// What the glTF reader does to the geometry of one primitive, without the file.
namespace vellus::asset::detail {

/// Joints and weights as the file has them: per set, four joints and one vec4 of weights per
/// vertex.
struct InfluenceSets {
    std::vector<std::vector<uint32_t>> joints;
    std::vector<std::vector<glm::vec4>> weights;
};

struct InfluenceRepairs {
    size_t dropped = 0;
    size_t weights = 0;
    bool joint_too_large = false;
};

/// Keeps the four strongest influences of each vertex and makes their weights sum to 1; counts the
/// vertices where that changed something. A vertex without any weight follows its first joint.
InfluenceRepairs reduce_influences(const InfluenceSets& sets, Primitive& primitive);

/// Turns indices of glTF mode 0..6 into one of our topologies; returns how many indices were left
/// over.
size_t assemble(int mode, Primitive& primitive);

/// Bytes of one vertex with all its attributes and morph targets.
size_t vertex_bytes(const Primitive& primitive);

/// Gives every index a vertex of its own, as flat shading needs; indices become 0, 1, 2, ...
void separate_vertices(Primitive& primitive);

/// Normalises normals; those missing or without length become the area-weighted mean of their
/// triangles (+Y where those have no area). Returns how many of the file's own were replaced.
size_t complete_normals(Primitive& primitive);

}  // namespace vellus::asset::detail
