#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/gpu/buffer.h"
#include "modules/scene/bounds.h"

namespace vellus::hair {

// What a groom needs of the mesh it grows on, worked out once by bind_roots. The records mirror
// shaders/hair/binding/bound_roots.glsl (scalar layout).

/// A vertex of the mesh that carries roots, as its file has it; the normal is smooth even where
/// the mesh is shaded flat.
struct BoundVertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::u16vec4 joints{0};
    glm::vec4 weights{1.0f, 0.0f, 0.0f, 0.0f};  ///< sum to 1
};
static_assert(sizeof(BoundVertex) == 48);

/// Displacements of a BoundVertex by one morph target.
struct BoundMorph {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
};
static_assert(sizeof(BoundMorph) == 24);

/// A strand's place on the mesh: a point of a triangle, and how the triangle lay in the rest frame.
struct BoundRoot {
    glm::uvec3 vertices{0};        ///< of the triangle, into BoundRoots::vertices
    glm::vec2 barycentric{0.0f};   ///< of the second and third vertex
    glm::vec4 rest_inverse{0.0f};  ///< 2x2, by columns: see root_axes in root_frame.glsl
    uint32_t first_point = 0;      ///< of the strand, in BoundRoots::local
    uint32_t point_count = 0;
    uint32_t flat = 0;  ///< 1: the triangle's normal is used, not its vertices'
};
static_assert(sizeof(BoundRoot) == 48);

/// Neighbouring strands as a box in the frame of one of them: bounds without looking at points.
struct BoundCluster {
    uint32_t strand = 0;
    glm::vec3 low{0.0f};
    glm::vec3 high{0.0f};
};

/// A groom bound to a mesh: columns by vertex, target, strand and point.
struct BoundRoots {
    std::vector<BoundVertex> vertices;
    std::vector<BoundMorph> morphs;  ///< target by target, each as long as `vertices`
    uint32_t target_count = 0;
    uint32_t joint_count = 1;
    std::vector<BoundRoot> roots;  ///< by strand
    /// Points in their strand's root frame (tangent, normal, bitangent), in the groom's metres:
    /// the shape at rest, whatever the pose.
    std::vector<glm::vec3> local;
    std::vector<BoundCluster> clusters;
    glm::dmat4 placement{1.0};  ///< groom to the rest space it was bound in
    double rest_scale = 1.0;    ///< metres there per metre of the groom, below 0 where it mirrors
    float reach = 0.0f;         ///< the longest of `local`
    double farthest = 0.0;      ///< largest distance of a root from the mesh at rest
};

/// The same on the device.
struct BoundRootBuffers {
    gpu::Buffer vertices;
    gpu::Buffer morphs;
    gpu::Buffer roots;
    gpu::Buffer local;

    /// Errors name the column that did not fit.
    static Result<BoundRootBuffers> upload(gpu::Device& device, const BoundRoots& bound);
    [[nodiscard]] uint64_t bytes() const;
};

/// Which groom is bound to which mesh, and how: two entities with the same one share a binding.
struct BindingKey {
    uint32_t groom = 0;  ///< of the HairLibrary
    uint32_t asset = 0;  ///< of the SceneLibrary
    uint32_t mesh = 0;   ///< node of the asset; without one, kMeshItself + mesh
    glm::dmat4 placement{1.0};

    bool operator==(const BindingKey&) const = default;
};
constexpr uint32_t kMeshItself = 1u << 31;

/// A binding of the library.
struct BoundGroom {
    BindingKey key;
    BoundRoots roots;
    BoundRootBuffers buffers;
};

/// All bindings of the world. Resource; an entry stays where it is as long as a HairBinding names
/// it, then its place serves another one.
struct HairBindings {
    std::vector<BoundGroom> list;
};

}  // namespace vellus::hair
