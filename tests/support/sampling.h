#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

namespace vellus::test {

/// SplitMix64 (Steele et al. 2014), started anew for each sample so that samples can run in any
/// order.
class Random {
  public:
    Random(uint64_t seed, uint64_t sample) : state_(seed * 0x9E3779B97F4A7C15u ^ (sample << 20)) {}

    uint64_t bits() {
        uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double range(double low, double high) { return low + (high - low) * unit(); }
    /// Uniform in the logarithm.
    double log_range(double low, double high) { return low * std::pow(high / low, unit()); }

    /// Uniform on the sphere.
    glm::dvec3 direction() {
        const double z = range(-1.0, 1.0);
        const double azimuth = range(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(azimuth), across * std::sin(azimuth), z};
    }

  private:
    uint64_t state_;
};

}  // namespace vellus::test
