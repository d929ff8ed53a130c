#pragma once

#include <memory>

#include "modules/hair/reference/tracer/environment_light.h"
#include "modules/hair/reference/tracer/geometry.h"
#include "modules/hair/reference/tracer/random.h"

namespace vellus::hair::tracer {

struct TraceSettings {
    /// Most scattering events along a path; 1 is direct light only, 0 is no limit (paths then end
    /// by Russian roulette alone).
    uint32_t max_depth = 0;
    /// Scattering events that are always followed; later ones by Russian roulette. Same mean.
    uint32_t roulette_from = 4;
    /// Choose directions towards the environment uniformly instead of by importance. Same mean.
    bool uniform_environment = false;
    /// Weigh light sampling against scattering (Veach's balance heuristic); else light sampling
    /// alone. Same mean.
    bool mis = true;
};

/// One sample of a pixel.
struct PathSample {
    glm::dvec3 radiance{0.0};
    bool covered = false;  ///< the camera's ray met hair or a mesh
    bool hair = false;     ///< it met hair first
};

/// Through a uniformly chosen point of pixel `at` of a picture of `size`.
Ray camera_ray(const Camera& camera, const glm::uvec2& at, const glm::uvec2& size, Random& random);

/// Unidirectional path tracing (Kajiya 1986) with next-event estimation: hair scatters as in Chiang
/// et al. 2016, meshes as in common/pbr.glsl. Thread-safe.
class PathTracer {
  public:
    static Result<std::unique_ptr<PathTracer>> create(Scene scene, const TraceSettings& settings);

    [[nodiscard]] const Scene& scene() const { return scene_; }
    /// Through a uniformly chosen point of pixel `at` of a picture of `size`.
    [[nodiscard]] PathSample sample(const glm::uvec2& at, const glm::uvec2& size,
                                    Random random) const;
    /// Radiance that arrives along a ray.
    [[nodiscard]] PathSample trace(Ray ray, Random& random) const;

  private:
    struct Vertex;

    PathTracer(Scene scene, const TraceSettings& settings);
    [[nodiscard]] Vertex vertex_at(const Ray& ray, const Hit& hit) const;
    [[nodiscard]] glm::dvec3 punctual_light(const Vertex& vertex, uint64_t seed) const;
    [[nodiscard]] glm::dvec3 environment_light(const Vertex& vertex, Random& random) const;
    [[nodiscard]] double environment_pdf(const glm::dvec3& direction) const;

    Scene scene_;
    TraceSettings settings_;
    EnvironmentLight environment_;
    std::unique_ptr<Geometry> geometry_;
};

}  // namespace vellus::hair::tracer
