#include "modules/hair/binding/rest_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <unordered_map>

namespace vellus::hair {

namespace {

struct PositionHash {
    size_t operator()(const glm::vec3& p) const {
        std::array<uint32_t, 3> bits{};
        std::memcpy(bits.data(), &p, sizeof(p));
        return (bits[0] * 0x9E3779B1u) ^ (bits[1] * 0x85EBCA77u) ^ (bits[2] * 0xC2B2AE3Du);
    }
};

/// For each vertex the first one at the same place: seams of texture and shading are none of the
/// skin's.
std::vector<uint32_t> weld(const std::vector<BoundVertex>& vertices) {
    std::vector<uint32_t> first(vertices.size());
    std::unordered_map<glm::vec3, uint32_t, PositionHash> known;
    for (uint32_t v = 0; v < vertices.size(); ++v) {
        // + 0 makes -0 equal to 0 in bits too.
        first[v] = known.emplace(vertices[v].position + 0.0f, v).first->second;
    }
    return first;
}

double angle_at(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 u = a - corner;
    const glm::dvec3 v = b - corner;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

/// Unit normals of the welded surface, each face weighted by its angle there; zero where there is
/// none.
std::vector<glm::dvec3> smooth_normals(std::span<const glm::dvec3> positions,
                                       std::span<const uint32_t> welded,
                                       std::span<const glm::uvec3> triangles) {
    std::vector<glm::dvec3> normals(positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : triangles) {
        const glm::dvec3 face =
            glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
        const double area = glm::length(face);
        if (!(area > 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            const double angle =
                angle_at(positions[t[k]], positions[t[(k + 1) % 3]], positions[t[(k + 2) % 3]]);
            normals[welded[t[k]]] += face * (angle / area);
        }
    }
    for (size_t v = 0; v < normals.size(); ++v) {
        if (welded[v] == v) {
            const double length = glm::length(normals[v]);
            if (length > 0.0) normals[v] /= length;
        } else {
            normals[v] = normals[welded[v]];
        }
    }
    return normals;
}

Result<void> add_primitive(const asset::Primitive& primitive, const std::string& name,
                           RestMesh& out) {
    const auto base = static_cast<uint32_t>(out.vertices.size());
    const bool skinned = !primitive.joints.empty() && !primitive.weights.empty();
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        BoundVertex vertex{.position = primitive.positions[v]};
        if (skinned) {
            vertex.joints = primitive.joints[v];
            vertex.weights = primitive.weights[v];
            const float sum =
                vertex.weights.x + vertex.weights.y + vertex.weights.z + vertex.weights.w;
            vertex.weights = sum > 0.0f ? vertex.weights / sum : glm::vec4(1, 0, 0, 0);
        }
        for (int k = 0; k < 4; ++k) {
            if (vertex.joints[k] < out.joint_count) continue;
            return Error{fmt::format("joint {} of vertex {}, but the skin has {}", vertex.joints[k],
                                     v, out.joint_count),
                         name, "export the mesh with its skin"};
        }
        out.vertices.push_back(vertex);
    }
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        out.triangles.emplace_back(base + primitive.indices[i], base + primitive.indices[i + 1],
                                   base + primitive.indices[i + 2]);
    }
    return {};
}

/// Displacements of all triangle primitives by one target, as long as the vertices.
std::vector<glm::dvec3> displacements(const asset::Mesh& mesh, uint32_t target) {
    std::vector<glm::dvec3> all;
    for (const asset::Primitive& primitive : mesh.primitives) {
        if (primitive.topology != asset::Topology::kTriangles) continue;
        for (size_t v = 0; v < primitive.positions.size(); ++v) {
            const bool has = target < primitive.morph_targets.size() &&
                             v < primitive.morph_targets[target].positions.size();
            all.push_back(has ? glm::dvec3(primitive.morph_targets[target].positions[v])
                              : glm::dvec3(0.0));
        }
    }
    return all;
}

/// Normals, and by how much each target turns them: of the moved surface, not of its shading.
void add_normals_and_morphs(const asset::Mesh& mesh, RestMesh& out) {
    const auto welded = weld(out.vertices);
    std::vector<glm::dvec3> base;
    for (const BoundVertex& v : out.vertices) base.emplace_back(v.position);
    const auto normals = smooth_normals(base, welded, out.triangles);
    for (size_t v = 0; v < out.vertices.size(); ++v) out.vertices[v].normal = normals[v];
    std::vector<glm::dvec3> moved(base.size());
    for (uint32_t t = 0; t < out.target_count; ++t) {
        const auto deltas = displacements(mesh, t);
        for (size_t v = 0; v < base.size(); ++v) moved[v] = base[v] + deltas[v];
        const auto turned = smooth_normals(moved, welded, out.triangles);
        for (size_t v = 0; v < base.size(); ++v) {
            out.morphs.push_back({glm::vec3(deltas[v]), glm::vec3(turned[v] - normals[v])});
        }
    }
}

/// Inverse transpose up to a positive factor.
glm::dvec3 map_normal(const glm::dmat3& m, const glm::dvec3& n) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    return cofactors * n * (glm::determinant(m) < 0.0 ? -1.0 : 1.0);
}

void pose(std::span<const glm::dmat4> palette, std::span<const float> weights, RestMesh& out) {
    for (size_t v = 0; v < out.vertices.size(); ++v) {
        const BoundVertex& vertex = out.vertices[v];
        glm::dvec3 position(vertex.position);
        glm::dvec3 normal(vertex.normal);
        for (uint32_t t = 0; t < out.target_count && t < weights.size(); ++t) {
            const BoundMorph& delta = out.morphs[t * out.vertices.size() + v];
            position += static_cast<double>(weights[t]) * glm::dvec3(delta.position);
            normal += static_cast<double>(weights[t]) * glm::dvec3(delta.normal);
        }
        glm::dmat4 m(0.0);
        for (int k = 0; k < 4; ++k) {
            m += static_cast<double>(vertex.weights[k]) * palette[vertex.joints[k]];
        }
        out.positions.emplace_back(m * glm::dvec4(position, 1.0));
        out.normals.push_back(map_normal(glm::dmat3(m), normal));
    }
}

glm::dmat4 local_matrix(const asset::Node& node) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(node.translation)) *
           glm::mat4_cast(glm::normalize(glm::dquat(node.rotation))) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(node.scale));
}

}  // namespace

Result<RestMesh> rest_mesh(const asset::Mesh& mesh, std::span<const glm::dmat4> palette,
                           std::span<const float> weights) {
    RestMesh result;
    result.joint_count = static_cast<uint32_t>(palette.size());
    for (const asset::Primitive& primitive : mesh.primitives) {
        if (primitive.topology != asset::Topology::kTriangles) continue;
        if (auto added = add_primitive(primitive, mesh.name, result); !added) return added.error();
        result.target_count =
            std::max(result.target_count, static_cast<uint32_t>(primitive.morph_targets.size()));
    }
    if (result.triangles.empty()) {
        return Error{"has no triangles", fmt::format("mesh '{}'", mesh.name),
                     "bind hair to a mesh with a surface"};
    }
    add_normals_and_morphs(mesh, result);
    pose(palette, weights, result);
    return result;
}

std::vector<glm::dmat4> rest_transforms(const asset::SceneAsset& scene) {
    std::vector<glm::dmat4> world(scene.nodes.size(), glm::dmat4(1.0));
    std::vector<uint32_t> next = scene.roots;
    std::vector<bool> reached(scene.nodes.size(), false);
    while (!next.empty()) {
        const uint32_t node = next.back();
        next.pop_back();
        if (node >= scene.nodes.size() || reached[node]) continue;
        reached[node] = true;
        const uint32_t parent = scene.nodes[node].parent;
        world[node] = local_matrix(scene.nodes[node]);
        if (parent < scene.nodes.size()) world[node] = world[parent] * world[node];
        next.insert(next.end(), scene.nodes[node].children.begin(),
                    scene.nodes[node].children.end());
    }
    return world;
}

std::vector<glm::dmat4> rest_palette(const asset::SceneAsset& scene, uint32_t node) {
    const auto transforms = rest_transforms(scene);
    const uint32_t index = scene.nodes[node].skin;
    if (index >= scene.skins.size() || scene.skins[index].joints.empty()) {
        return {transforms[node]};
    }
    const asset::Skin& skin = scene.skins[index];
    std::vector<glm::dmat4> palette;
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        palette.push_back(transforms[skin.joints[j]] * (skin.inverse_bind.empty()
                                                            ? glm::dmat4(1.0)
                                                            : glm::dmat4(skin.inverse_bind[j])));
    }
    return palette;
}

Result<RestMesh> rest_mesh(const asset::SceneAsset& scene, uint32_t node) {
    const auto where = [&] {
        return fmt::format("{}: node {} '{}'", scene.path.string(), node, scene.nodes[node].name);
    };
    const asset::Node& given = scene.nodes[node];
    if (given.mesh >= scene.meshes.size()) {
        return Error{"has no mesh", where(), "bind hair to a node with a mesh"};
    }
    const asset::Mesh& mesh = scene.meshes[given.mesh];
    auto rest = rest_mesh(mesh, rest_palette(scene, node),
                          given.morph_weights.empty() ? mesh.morph_weights : given.morph_weights);
    if (rest) return rest;
    Error error = rest.error();
    error.where = where() + ", " + error.where;
    return error;
}

}  // namespace vellus::hair
