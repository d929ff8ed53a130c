#include <cmath>

#include "assets/generator/bust.h"
#include "assets/generator/hair_style.h"
#include "assets/generator/random.h"
#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr uint32_t kBrowHairs = 210;
constexpr uint32_t kLashes = 70;
constexpr int kShortPoints = 6;

/// One hair of the left eyebrow: rises at the inner end, lies along the brow at the outer one.
Strand brow_hair(uint32_t key) {
    const double along = random(key, 51);
    const double across = spread(key, 52) * (1.0 - 0.65 * smoothstep(0.35, 1.0, along));
    const double arch = along * (1.0 - along) * 4.0;
    dvec3 p(mix(0.0125, 0.0480, along), 0.0165 + 0.0050 * arch + 0.0035 * along + 0.0026 * across,
            0.09);
    p = project(skin_distance, project(skin_distance, p));
    const double rise = mix(1.1, -0.35, smoothstep(0.0, 0.75, along)) - 0.35 * across;
    dvec3 direction = glm::normalize(dvec3(1.0, rise + 0.2 * spread(key, 53), 0.0));
    const double step = (0.0062 + 0.002 * random(key, 54)) / (kShortPoints - 1);
    Strand strand{p};
    for (int i = 1; i < kShortPoints; ++i) {
        direction = glm::normalize(direction + dvec3(0.05, -0.06, 0.0));
        p += direction * step;
        const dvec3 normal = normal_of(skin_distance, p);
        p += normal * (0.0005 + 0.0001 * i - skin_distance(p));
        strand.push_back(p);
    }
    return strand;
}

/// One lash of the left upper lid: out of the rim, forwards, then up.
Strand lash(uint32_t key) {
    const double t = spread(key, 61) * 0.93;
    const double radius = kEyeRadius + 0.0009;
    dvec3 offset = upper_lid_rim(t) - kEyeCenter;
    offset.z =
        std::sqrt(std::max(0.0, radius * radius - offset.x * offset.x - offset.y * offset.y));
    dvec3 p = kEyeCenter + offset;
    dvec3 direction = glm::normalize(dvec3(0.35 * t + 0.08 * spread(key, 62) + 0.1, -0.15, 0.75));
    const double step = (0.0060 + 0.0015 * random(key, 63) + 0.001 * t) / (kShortPoints - 1);
    Strand strand{p};
    for (int i = 1; i < kShortPoints; ++i) {
        direction = glm::normalize(direction + dvec3(0.02 * t, 0.26, 0.0));
        p += direction * step;
        strand.push_back(p);
    }
    return strand;
}

}  // namespace

std::vector<Strand> grow_brows() {
    std::vector<Strand> brows;
    for (uint32_t i = 0; i < 2 * (kBrowHairs + kLashes); ++i) {
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        Strand strand = i / 2 < kBrowHairs ? brow_hair(i) : lash(i);
        for (dvec3& point : strand) {
            point = push_out(skin_distance, point, &point == strand.data() ? -0.0004 : 0.0002);
            point.x *= side;
        }
        brows.push_back(std::move(strand));
    }
    return brows;
}

}  // namespace vellus::sculpt
