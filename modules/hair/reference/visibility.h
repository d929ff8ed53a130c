#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace vellus::hair::reference {

/// A piece of a strand: the hull of two balls, as Embree's round linear curves.
struct RoundSegment {
    glm::dvec3 a{0.0};
    glm::dvec3 b{0.0};
    double radius_a = 0.0;  ///< metres, >= 0
    double radius_b = 0.0;
    double opacity = 1.0;  ///< share of the light it stops, in [0, 1]
    uint32_t strand = 0;
};

/// Where a ray is inside a strand, in units of its direction's length.
struct Crossing {
    double enter = 0.0;
    double leave = 0.0;
    double opacity = 1.0;
    uint32_t strand = 0;
};

/// The interval a ray (any length of direction but 0, both ways infinite) spends inside the
/// segment; false where it misses or only touches.
bool intersect(const RoundSegment& segment, const glm::dvec3& origin, const glm::dvec3& direction,
               double& enter, double& leave);

/// All crossings that begin beyond the origin, by `enter`. Pieces of one strand that overlap count
/// once, with the larger opacity; a strand the origin lies in does not count.
std::vector<Crossing> crossings(std::span<const RoundSegment> segments, const glm::dvec3& origin,
                                const glm::dvec3& direction);

/// Exact transmittance of a ray as a function of depth: a product over the strands before it.
class Transmittance {
  public:
    Transmittance() = default;
    explicit Transmittance(std::span<const Crossing> sorted);

    /// What arrives at `depth` in units of the direction; 1 before the first strand.
    [[nodiscard]] double at(double depth) const;
    /// Where it steps, and what is left after each step.
    [[nodiscard]] const std::vector<double>& depths() const { return depths_; }
    [[nodiscard]] const std::vector<double>& values() const { return values_; }

  private:
    std::vector<double> depths_;
    std::vector<double> values_;
};

/// By testing every segment.
Transmittance transmittance_along(std::span<const RoundSegment> segments, const glm::dvec3& origin,
                                  const glm::dvec3& direction);

}  // namespace vellus::hair::reference
