#include "assets/generator/ground.h"

#include <cmath>

#include "assets/generator/random.h"
#include "assets/generator/sdf.h"
#include "assets/generator/trigonometry.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr int kSides = 48;

double from_path(const Ground& ground, double x, double z) {
    const double wobble = 0.06 * noise({x, 0.0, z}, 1.7, 91);
    return std::abs(std::sqrt(x * x + z * z) - ground.path_radius) + wobble;
}

dvec3 color_at(const Ground& ground, dvec3 p) {
    const double away = std::sqrt(p.x * p.x + p.z * p.z);
    const dvec3 flat(p.x, 0.0, p.z);
    const double patch = 0.5 + 0.5 * noise(flat, 2.3, 92);
    const double tuft = noise(flat, 0.61, 93);
    dvec3 lawn = glm::mix(dvec3(0.150, 0.225, 0.062), dvec3(0.240, 0.270, 0.085), patch);
    lawn *= 1.0 + 0.13 * tuft;
    const double gravel = noise(flat, 0.47, 94);
    const dvec3 path = dvec3(0.52, 0.43, 0.32) * (1.0 + 0.07 * gravel + 0.05 * patch);
    const double half = 0.5 * ground.path_width;
    const double on_path = smoothstep(half + 0.10, half - 0.10, from_path(ground, p.x, p.z));
    dvec3 color = glm::mix(lawn, path, on_path);
    // Hills fade into the haze.
    return glm::mix(color, dvec3(0.30, 0.33, 0.36), 0.8 * smoothstep(12.0, ground.reach, away));
}

/// Distances of the rings from the origin.
std::vector<double> ring_radii(const Ground& ground) {
    std::vector<double> radii;
    const double inner = ground.path_radius - 0.5 * ground.path_width - 0.2;
    const double outer = ground.path_radius + 0.5 * ground.path_width + 0.2;
    for (int i = 1; i <= 4; ++i) {
        radii.push_back(inner * i / 4.0);
    }
    for (int i = 1; i <= 7; ++i) {
        radii.push_back(mix(inner, outer, i / 7.0));
    }
    double r = outer * 1.08;
    while (r < ground.reach) {
        radii.push_back(r);
        r *= 1.42;
    }
    radii.push_back(ground.reach);
    return radii;
}

}  // namespace

double ground_height(const Ground& ground, double x, double z) {
    const double away = std::sqrt(x * x + z * z);
    const double swell = smoothstep(0.25, 1.6, from_path(ground, x, z) - 0.5 * ground.path_width);
    const double near = 0.045 * swell * (1.0 + noise({x, 0.0, z}, 3.1, 95));
    const double hills = smoothstep(12.0, 45.0, away) * (1.1 + 1.6 * noise({x, 0.0, z}, 41.0, 96));
    const double rim = smoothstep(40.0, ground.reach, away);
    return near + std::max(hills, 0.0) * (1.0 - rim) - 1.2 * rim;
}

SkinnedPart make_ground(const Ground& ground) {
    SkinnedPart part{"ground", {}, {}, {}, dvec3(1.0), 0.95};
    std::vector<dvec3>& positions = part.surface.positions;
    std::vector<dvec3>& normals = part.surface.normals;
    std::vector<uint32_t>& indices = part.surface.indices;
    const auto add = [&](double x, double z) {
        constexpr double kStep = 0.05;
        const auto height = [&](double u, double v) { return ground_height(ground, u, v); };
        positions.emplace_back(x, height(x, z), z);
        normals.push_back(
            glm::normalize(dvec3(height(x - kStep, z) - height(x + kStep, z), 2.0 * kStep,
                                 height(x, z - kStep) - height(x, z + kStep))));
        part.colors.push_back(color_at(ground, positions.back()));
    };
    add(0.0, 0.0);
    const std::vector<double> radii = ring_radii(ground);
    for (size_t ring = 0; ring < radii.size(); ++ring) {
        for (int i = 0; i < kSides; ++i) {
            const double turns = (i + (ring % 2 == 0 ? 0.0 : 0.5)) / kSides;
            add(radii[ring] * sine(turns), radii[ring] * cosine(turns));
        }
    }
    const auto vertex = [&](size_t ring, int i) {
        return static_cast<uint32_t>(1 + ring * kSides + static_cast<size_t>(i % kSides));
    };
    for (int i = 0; i < kSides; ++i) {
        indices.insert(indices.end(), {0, vertex(0, i), vertex(0, i + 1)});
        for (size_t ring = 0; ring + 1 < radii.size(); ++ring) {
            // Odd rings are half a step ahead.
            const int ahead = ring % 2 == 0 ? 0 : 1;
            const uint32_t a = vertex(ring, i);
            const uint32_t b = vertex(ring, i + 1);
            const uint32_t c = vertex(ring + 1, i + ahead);
            const uint32_t d = vertex(ring + 1, i + ahead + kSides - 1);
            indices.insert(indices.end(), {a, c, b, a, d, c});
        }
    }
    return part;
}

}  // namespace vellus::sculpt
