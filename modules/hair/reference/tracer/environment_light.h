#pragma once

#include <vector>

#include "modules/hair/reference/tracer/scene.h"

namespace vellus::hair::tracer {

/// An environment that can be looked at and sampled by its brightness. Radiance is bilinear between
/// texel centres; texels are chosen by the mean brightness that bilinear filter spreads over them
/// (so no bright direction is impossible), and uniformly in solid angle within.
class EnvironmentLight {
  public:
    EnvironmentLight() = default;  ///< black
    explicit EnvironmentLight(const Environment& environment);

    [[nodiscard]] bool black() const { return row_share_.empty(); }
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const;

    struct Sample {
        glm::dvec3 direction{0.0};
        double pdf = 0.0;  ///< 1/sr
    };
    /// By importance, from two uniform numbers. Not for black ones.
    [[nodiscard]] Sample sample(const glm::dvec2& u) const;
    [[nodiscard]] double pdf(const glm::dvec3& direction) const;

  private:
    [[nodiscard]] glm::dvec3 to_image(const glm::dvec3& direction) const;
    [[nodiscard]] double texel_pdf(size_t row, size_t column) const;

    asset::ImageF pixels_;
    double intensity_ = 1.0;
    glm::dvec2 turn_{1.0, 0.0};         // cosine and sine of the rotation
    std::vector<double> row_share_;     // cumulative, height + 1
    std::vector<double> column_share_;  // cumulative within each row, height x (width + 1)
};

}  // namespace vellus::hair::tracer
