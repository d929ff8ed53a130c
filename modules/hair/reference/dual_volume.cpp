#include "modules/hair/reference/dual_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostScatterings = 2000;

/// Optical depth from a point `depth` below the face towards `light`.
double depth_to_light(const FibreSlab& slab, double depth, const SlabDirection& light) {
    const double cosine = std::cos(light.phi);
    return cosine > 0.0 ? depth / std::max(cosine, 1e-12)
                        : (slab.thickness - depth) / std::max(-cosine, 1e-12);
}

}  // namespace

glm::dvec3 slab_radiance(const FibreSlab& slab, SlabDirection eye, SlabDirection light, int paths,
                         uint64_t seed, bool single) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Inclination to_light{std::sin(light.theta), std::cos(light.theta)};
    glm::dvec3 sum(0.0);
    for (int path = 0; path < paths; ++path) {
        Inclination from{std::sin(eye.theta), std::cos(eye.theta)};
        double azimuth = eye.phi;
        double depth = 0.0;
        glm::dvec3 weight(1.0);
        for (int event = 0; event < kMostScatterings; ++event) {
            // Away from where we look from: down for an azimuth that faces the light's side.
            depth += -std::log(1.0 - unit(engine)) * std::cos(azimuth);
            if (depth < 0.0 || depth > slab.thickness) break;
            const ChiangScattering scattering(slab.fibre, 2.0 * unit(engine) - 1.0, from);
            const double arriving = std::exp(-depth_to_light(slab, depth, light));
            sum += weight * scattering.evaluate(to_light, light.phi - azimuth) * arriving;
            if (single) break;
            const auto sample =
                scattering.sample({unit(engine), unit(engine), unit(engine), unit(engine)});
            weight *= sample.weight;
            const double most = std::max({weight.x, weight.y, weight.z});
            if (most <= 0.0) break;
            if (most < 0.05) {
                if (unit(engine) > most / 0.05) break;
                weight *= 0.05 / most;
            }
            // The next fibre is where this light comes from; it sends it back the way we came.
            from = {-sample.i.sin, sample.i.cos};
            azimuth += sample.phi + kPi;
        }
    }
    return sum / static_cast<double>(paths);
}

}  // namespace vellus::hair::reference
