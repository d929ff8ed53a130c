#include "game_demo/tools/accuracy/radiance.h"

#include <array>
#include <cassert>
#include <cmath>

namespace vellus::demo {

namespace {

double sum(const glm::dvec3& c) {
    return c.x + c.y + c.z;
}

double total(const glm::dvec3& b) {
    return sum(glm::abs(b));
}

/// Sums of `of` over the blocks of the weighted difference and of the weighted reference.
template <class Of>
std::array<double, 2> block_totals(const Radiance& picture, const Reference& reference, Of of) {
    assert(picture.pixels.size() == reference.picture.pixels.size());
    const auto weighted = [&](size_t i, const glm::vec3& c) {
        return static_cast<double>(reference.weight[i]) * glm::dvec3(c);
    };
    const auto& a = picture.pixels;
    const auto& b = reference.picture.pixels;
    std::array<double, 2> totals{};
    for (const glm::dvec3& c : block_sums(picture.size, reference.block, [&](size_t i) {
             return weighted(i, a[i]) - weighted(i, b[i]);
         })) {
        totals[0] += of(c);
    }
    for (const glm::dvec3& c :
         block_sums(picture.size, reference.block, [&](size_t i) { return weighted(i, b[i]); })) {
        totals[1] += of(c);
    }
    return totals;
}

double ratio(const std::array<double, 2>& totals) {
    return totals[1] > 0.0 ? totals[0] / totals[1] : 0.0;
}

}  // namespace

double relative_l1(const Radiance& picture, const Reference& reference) {
    return ratio(block_totals(picture, reference, total));
}

double relative_l2(const Radiance& picture, const Reference& reference) {
    return std::sqrt(ratio(
        block_totals(picture, reference, [](const glm::dvec3& c) { return glm::dot(c, c); })));
}

double mean_difference(const Radiance& picture, const Reference& reference) {
    double total_weight = 0.0;
    for (const float weight : reference.weight) total_weight += static_cast<double>(weight);
    const auto totals =
        block_totals(picture, reference, [](const glm::dvec3& c) { return std::abs(c.y); });
    return ratio({totals[0], total_weight});
}

double relative_bias(const Radiance& picture, const Reference& reference) {
    std::array<double, 2> totals{};
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const double weight = reference.weight[i];
        totals[0] += weight * sum(picture.pixels[i] - reference.picture.pixels[i]);
        totals[1] += weight * total(reference.picture.pixels[i]);
    }
    return ratio(totals);
}

Radiance mean_of(std::span<const Radiance> frames) {
    Radiance mean{frames[0].size, std::vector<glm::vec3>(frames[0].pixels.size())};
    for (size_t i = 0; i < mean.pixels.size(); ++i) {
        glm::dvec3 total(0.0);
        for (const Radiance& frame : frames) total += frame.pixels[i];
        mean.pixels[i] = total / static_cast<double>(frames.size());
    }
    return mean;
}

double flicker(std::span<const Radiance> frames, const Reference& reference) {
    double above = 0.0;
    double below = 0.0;
    const auto count = static_cast<double>(frames.size());
    for (size_t i = 0; i < reference.picture.pixels.size(); ++i) {
        double first = 0.0;
        double second = 0.0;
        for (const Radiance& frame : frames) {
            const double value = sum(frame.pixels[i]);
            first += value / count;
            second += value * value / count;
        }
        above += reference.weight[i] * std::sqrt(std::max(second - first * first, 0.0));
        below += reference.weight[i] * total(reference.picture.pixels[i]);
    }
    return ratio({above, below});
}

}  // namespace vellus::demo
