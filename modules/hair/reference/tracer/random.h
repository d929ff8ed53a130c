#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace vellus::hair::tracer {

/// 64-bit finaliser of SplitMix64 (Steele et al. 2014, variant 13).
constexpr uint64_t mix_bits(uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31U);
}

/// The random numbers of one sample of one pixel: they depend on nothing but seed, pixel and
/// sample, so the picture does not depend on threads, tiles or pauses.
class Random {
  public:
    Random(uint64_t seed, uint32_t pixel, uint32_t sample)
        : state_(mix_bits(mix_bits(seed + kStep) ^ ((uint64_t{pixel} << 32U) | sample))) {}

    uint64_t bits() { return mix_bits(state_ += kStep); }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
    glm::dvec2 unit2() {
        const double x = unit();
        return {x, unit()};
    }
    glm::dvec4 unit4() {
        const glm::dvec2 xy = unit2();
        return {xy, unit2()};
    }

  private:
    static constexpr uint64_t kStep = 0x9E3779B97F4A7C15u;
    uint64_t state_;
};

}  // namespace vellus::hair::tracer
