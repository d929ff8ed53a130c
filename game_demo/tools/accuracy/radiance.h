#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/asset/image.h"

namespace vellus::demo {

/// Linear colours, row by row from the top left.
struct Radiance {
    glm::uvec2 size{0};
    std::vector<glm::vec3> pixels;
};

/// What pictures are compared with.
struct Reference {
    Radiance picture;
    /// By pixel, how much it counts: the share of it that is hair, or 1.
    std::vector<float> weight;
    /// Pictures are compared by the means of blocks of so many pixels a side: more than 1 where the
    /// reference has noise of its own, which they halve with each doubling.
    uint32_t block = 1;
    /// Error that this noise adds to the relative L1 of whatever is compared with it.
    double noise = 0.0;
};

/// Σ |Σ w (a - b)| / Σ |Σ w b|, the outer sums over blocks and channels, the inner over a block.
double relative_l1(const Radiance& picture, const Reference& reference);
/// √(Σ (Σ w (a - b))² / Σ (Σ w b)²).
double relative_l2(const Radiance& picture, const Reference& reference);
/// Σ |Σ w (a - b)| / Σ w of the green channel, the inner sum over a block: mean |ΔV| where pictures
/// are transmittances.
double mean_difference(const Radiance& picture, const Reference& reference);
/// Σ w (a - b) / Σ w |b|: how much too bright the picture is as a whole.
double relative_bias(const Radiance& picture, const Reference& reference);
/// Mean over pixels of the standard deviation in time over the mean brightness of the reference.
double flicker(std::span<const Radiance> frames, const Reference& reference);
/// By block of `block` pixels a side: the sum of what `of` gives for each pixel.
template <class Of>
std::vector<glm::dvec3> block_sums(const glm::uvec2& size, uint32_t block, Of of) {
    const glm::uvec2 blocks = (size + block - 1u) / block;
    std::vector<glm::dvec3> sums(size_t{blocks.x} * blocks.y, glm::dvec3(0.0));
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            sums[size_t{y / block} * blocks.x + x / block] += of(size_t{y} * size.x + x);
        }
    }
    return sums;
}

/// Pixel by pixel.
Radiance mean_of(std::span<const Radiance> frames);

}  // namespace vellus::demo
