#pragma once

#include <memory>

#include "engine/platform/result.h"
#include "modules/hair/reference/tracer/scene.h"

namespace vellus::hair::tracer {

/// The strand a ray starts on; it does not meet it again before `until`.
struct OwnStrand {
    uint32_t groom = kNone;
    uint32_t strand = kNone;
    double until = 0.0;
};

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit
    double near = 0.0;
    OwnStrand own;
    uint64_t seed = 0;         ///< decides what translucent things stop this ray
    bool from_camera = false;  ///< does not see the back of one-sided meshes
    bool ignores_hair = false;
};

/// What a ray meets first.
struct Hit {
    double distance = 0.0;
    uint32_t groom = kNone;  ///< or `mesh`
    uint32_t mesh = kNone;
    uint32_t primitive = 0;  ///< segment or triangle
    glm::dvec2 at{0.0};      ///< along the segment, or barycentric of the second and third vertex
    glm::dvec3 normal{0.0};  ///< geometric, unit
};

/// All of a scene in Embree: strands as rounded cones, meshes as triangles. A strand of opacity α
/// stops a ray with that probability, the whole strand at once.
class Geometry {
  public:
    /// Errors say what Embree did not like.
    static Result<std::unique_ptr<Geometry>> build(const Scene& scene);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    /// Thread-safe, as is the next.
    [[nodiscard]] bool closest(const Ray& ray, Hit& hit) const;
    /// Whether anything is met before `distance`.
    [[nodiscard]] bool blocked(const Ray& ray, double distance) const;

  private:
    struct Embree;
    explicit Geometry(std::unique_ptr<Embree> embree);
    std::unique_ptr<Embree> embree_;
};

/// Base colour, and opacity where the material has one, of a point on a mesh.
glm::vec4 mesh_color(const Scene& scene, const Mesh& mesh, uint32_t triangle, const glm::dvec2& at);

}  // namespace vellus::hair::tracer
