#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/asset/image.h"
#include "engine/asset/image_planes.h"
#include "modules/hair/reference/tracer/integrator.h"

namespace vellus::hair::tracer {

/// Sums over the samples of each pixel, in double and in the order of the samples: adding some now
/// and the rest later gives the same bits.
class Film {
  public:
    Film() = default;
    explicit Film(const glm::uvec2& size);

    [[nodiscard]] const glm::uvec2& size() const { return size_; }
    [[nodiscard]] size_t pixel_count() const { return pixels_.size(); }
    /// Samples that pixel `index` has; the next one gets that number.
    [[nodiscard]] uint32_t count(size_t index) const { return pixels_[index].count; }
    /// Samples that every pixel has.
    [[nodiscard]] uint32_t complete() const;
    /// Pixels may be added to from different threads, each from one.
    void add(size_t index, const PathSample& sample);

    [[nodiscard]] glm::dvec3 mean(size_t index) const;
    /// Standard error of that mean, from the spread of the samples; 0 for fewer than two.
    [[nodiscard]] glm::dvec3 standard_error(size_t index) const;
    [[nodiscard]] double coverage(size_t index) const;
    [[nodiscard]] double hair(size_t index) const;

    /// Planes R, G, B (linear radiance), A (share of camera rays that met anything), error.R,
    /// error.G, error.B, and hair (share that met hair first).
    [[nodiscard]] asset::PlaneImage planes() const;
    /// What the display shows of it: exposure, tone map and encoding of the demo.
    [[nodiscard]] asset::Image display(float exposure) const;

    /// All sums with `fingerprint` of what they are sums of.
    [[nodiscard]] std::vector<std::byte> checkpoint(uint64_t fingerprint) const;
    /// Errors: no checkpoint, or one of another picture.
    static Result<Film> from_checkpoint(std::span<const std::byte> bytes, uint64_t fingerprint);

  private:
    struct Pixel {
        glm::dvec3 sum{0.0};
        glm::dvec3 squares{0.0};
        uint32_t count = 0;
        uint32_t covered = 0;
        uint32_t hair = 0;
        uint32_t unused = 0;
    };
    static_assert(sizeof(Pixel) == 64);

    glm::uvec2 size_{0};
    std::vector<Pixel> pixels_;
};

}  // namespace vellus::hair::tracer
