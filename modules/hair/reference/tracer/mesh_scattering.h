#pragma once

#include <glm/glm.hpp>

#include "shaders/common/portable.h"

namespace vellus::hair::tracer {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/pbr.glsl"
}  // namespace glsl

/// The surface of a character as its shader has it (common/pbr.glsl), with a sampler: cosine lobe
/// and GGX's visible normals (Heitz 2018).
class MeshScattering {
  public:
    MeshScattering(const glsl::PbrSurface& surface, const glm::dvec3& normal,
                   const glm::dvec3& to_eye);

    /// BRDF times cosine, 1/sr.
    [[nodiscard]] glm::dvec3 evaluate(const glm::dvec3& to_light) const;
    [[nodiscard]] double pdf(const glm::dvec3& to_light) const;

    struct Sample {
        glm::dvec3 direction{0.0};
        double pdf = 0.0;
        glm::dvec3 weight{0.0};  ///< evaluate / pdf; 0 below the horizon
    };
    /// From three uniform numbers in [0, 1).
    [[nodiscard]] Sample sample(const glm::dvec3& u) const;

  private:
    glsl::PbrSurface surface_;
    glm::dvec3 normal_;
    glm::dvec3 to_eye_;
    glm::dmat3 frame_;     // columns: two tangents, the normal
    glm::dvec3 eye_;       // in the frame, above the horizon
    double alpha_;         // GGX
    double mirror_share_;  // probability of the specular lobe
};

}  // namespace vellus::hair::tracer
