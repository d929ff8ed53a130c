#include "game_demo/tools/accuracy/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "engine/platform/jobs.h"

namespace vellus::demo {

namespace {

constexpr double kPi = std::numbers::pi;

// Constants of the paper's section 4.
constexpr double kColourExponent = 0.7;   // q_c
constexpr double kColourKnee = 0.4;       // p_c
constexpr double kKneeError = 0.95;       // p_t
constexpr double kFeatureWidth = 0.082;   // w, degrees
constexpr double kFeatureExponent = 0.5;  // q_f

using Plane = std::vector<double>;
using Colours = std::vector<glm::dvec3>;

// sRGB's primaries and D65 (IEC 61966-2-1); columns.
const glm::dmat3 kToXyz(0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522, 0.1191920, 0.1804375,
                        0.0721750, 0.9503041);
const glm::dmat3 kFromXyz = glm::inverse(kToXyz);
const glm::dvec3 kWhite = kToXyz * glm::dvec3(1.0);

double srgb_decode(double x) {
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// The opponent space the eye's contrast sensitivity is known in: linearised CIELAB.
glm::dvec3 to_opponent(const glm::dvec3& linear) {
    const glm::dvec3 n = kToXyz * linear / kWhite;
    return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}

glm::dvec3 from_opponent(const glm::dvec3& c) {
    const double y = (c.x + 16.0) / 116.0;
    return kFromXyz * (glm::dvec3(y + c.y / 500.0, y, y - c.z / 200.0) * kWhite);
}

/// CIELAB with chroma scaled by lightness (Hunt effect).
glm::dvec3 to_hunt_lab(const glm::dvec3& linear) {
    constexpr double kDelta = 6.0 / 29.0;
    const auto f = [](double t) {
        return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                            : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const glm::dvec3 n = kToXyz * linear / kWhite;
    const double y = f(n.y);
    const double lightness = 116.0 * y - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f(n.x) - y),
            0.01 * lightness * 200.0 * (y - f(n.z))};
}

/// HyAB distance (Abasi et al. 2020).
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

/// Convolution with the product of a row and a column kernel; borders repeat.
Plane convolve(const Plane& plane, glm::uvec2 size, const Plane& row, const Plane& column) {
    const auto along = [&](const Plane& from, const Plane& kernel, bool vertical) {
        const int radius = static_cast<int>(kernel.size() / 2);
        const glm::ivec2 limit = glm::ivec2(size) - 1;
        Plane to(from.size());
        parallel_ranges(size.y, 8, [&](size_t first, size_t last) {
            for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
                for (int x = 0; x <= limit.x; ++x) {
                    double sum = 0.0;
                    for (int k = -radius; k <= radius; ++k) {
                        const int sx = vertical ? x : std::clamp(x + k, 0, limit.x);
                        const int sy = vertical ? std::clamp(y + k, 0, limit.y) : y;
                        sum += kernel[k + radius] * from[size_t(sy) * size.x + sx];
                    }
                    to[size_t(y) * size.x + x] = sum;
                }
            }
        });
        return to;
    };
    return along(along(plane, row, false), column, true);
}

Plane sampled(int radius, const std::function<double(double)>& f) {
    Plane kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(f(i));
    return kernel;
}

double sum(const Plane& kernel) {
    double total = 0.0;
    for (const double value : kernel) total += value;
    return total;
}

/// One term of a contrast sensitivity in space: a √(π/b) e^(-π² r² / b), r in degrees.
struct SensitivityTerm {
    double a = 0.0;
    double b = 1.0;
};

/// A channel through its contrast sensitivity filter (table 1), which is normalised to 1.
Plane filtered(const Plane& plane, glm::uvec2 size, std::span<const SensitivityTerm> terms,
               double pixels_per_degree) {
    constexpr double kWidest = 0.04;
    const int radius = static_cast<int>(
        std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixels_per_degree));
    Plane result(plane.size(), 0.0);
    double total = 0.0;
    for (const SensitivityTerm& term : terms) {
        const Plane kernel = sampled(radius, [&](double i) {
            return std::exp(-kPi * kPi * i * i / (pixels_per_degree * pixels_per_degree * term.b));
        });
        const double scale = term.a * std::sqrt(kPi / term.b);
        const Plane part = convolve(plane, size, kernel, kernel);
        for (size_t i = 0; i < part.size(); ++i) result[i] += scale * part[i];
        total += scale * sum(kernel) * sum(kernel);
    }
    for (double& value : result) value /= total;
    return result;
}

/// A picture in the opponent space.
Colours opponent(const std::vector<glm::vec3>& picture) {
    Colours colours;
    for (const glm::vec3& c : picture) {
        colours.push_back(to_opponent({srgb_decode(c.x), srgb_decode(c.y), srgb_decode(c.z)}));
    }
    return colours;
}

/// What of it the eye resolves, in the space colours are compared in.
Colours perceived(const Colours& colours, glm::uvec2 size, double pixels_per_degree) {
    constexpr std::array<SensitivityTerm, 1> kLight = {{{1.0, 0.0047}}};
    constexpr std::array<SensitivityTerm, 1> kRedGreen = {{{1.0, 0.0053}}};
    constexpr std::array<SensitivityTerm, 2> kBlueYellow = {{{34.1, 0.04}, {13.5, 0.025}}};
    const std::array<std::span<const SensitivityTerm>, 3> terms = {kLight, kRedGreen, kBlueYellow};
    Colours result(colours.size());
    for (int channel = 0; channel < 3; ++channel) {
        Plane plane(colours.size());
        for (size_t i = 0; i < plane.size(); ++i) plane[i] = colours[i][channel];
        plane = filtered(plane, size, terms[channel], pixels_per_degree);
        for (size_t i = 0; i < plane.size(); ++i) result[i][channel] = plane[i];
    }
    for (glm::dvec3& c : result) c = to_hunt_lab(glm::clamp(from_opponent(c), 0.0, 1.0));
    return result;
}

/// Lengths of the responses to edges and to points.
struct Features {
    Plane edge;
    Plane point;
};

Features features(const Colours& colours, glm::uvec2 size, double pixels_per_degree) {
    const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    const Plane smooth = sampled(radius, gauss);
    Plane first = sampled(radius, [&](double x) { return -x * gauss(x); });
    Plane second =
        sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gauss(x); });
    // Positive and negative weights of the product with `smooth` sum to 1 and -1.
    for (Plane* kernel : {&first, &second}) {
        double positive = 0.0;
        double negative = 0.0;
        for (const double value : *kernel) (value > 0.0 ? positive : negative) += value;
        for (double& value : *kernel) {
            value /= (value > 0.0 ? positive : -negative) * sum(smooth);
        }
    }
    Plane light(colours.size());
    for (size_t i = 0; i < light.size(); ++i) light[i] = (colours[i].x + 16.0) / 116.0;
    const auto response = [&](const Plane& kernel) {
        Plane across = convolve(light, size, kernel, smooth);
        const Plane down = convolve(light, size, smooth, kernel);
        for (size_t i = 0; i < across.size(); ++i) across[i] = std::hypot(across[i], down[i]);
        return across;
    };
    return {response(first), response(second)};
}

/// Colour differences compressed so that most of [0, 1] is left to small ones (equation 11).
double colour_error(const glm::dvec3& a, const glm::dvec3& b) {
    static const double kLargest =
        std::pow(hyab(to_hunt_lab({0.0, 1.0, 0.0}), to_hunt_lab({0.0, 0.0, 1.0})), kColourExponent);
    const double knee = kColourKnee * kLargest;
    const double error = std::pow(hyab(a, b), kColourExponent);
    if (error < knee) return kKneeError / knee * error;
    return kKneeError + (error - knee) / (kLargest - knee) * (1.0 - kKneeError);
}

}  // namespace

std::vector<float> flip(const std::vector<glm::vec3>& picture,
                        const std::vector<glm::vec3>& reference, glm::uvec2 size,
                        double pixels_per_degree) {
    assert(picture.size() == size_t{size.x} * size.y && reference.size() == picture.size());
    const Colours a = opponent(picture);
    const Colours b = opponent(reference);
    const Colours seen_a = perceived(a, size, pixels_per_degree);
    const Colours seen_b = perceived(b, size, pixels_per_degree);
    const Features drawn_a = features(a, size, pixels_per_degree);
    const Features drawn_b = features(b, size, pixels_per_degree);
    std::vector<float> error(picture.size());
    for (size_t i = 0; i < error.size(); ++i) {
        const double feature = std::max(std::abs(drawn_a.edge[i] - drawn_b.edge[i]),
                                        std::abs(drawn_a.point[i] - drawn_b.point[i]));
        const double sharpened =
            std::clamp(std::pow(feature / std::sqrt(2.0), kFeatureExponent), 0.0, 1.0);
        const double colour = std::clamp(colour_error(seen_a[i], seen_b[i]), 0.0, 1.0);
        error[i] = static_cast<float>(std::pow(colour, 1.0 - sharpened));
    }
    return error;
}

}  // namespace vellus::demo
