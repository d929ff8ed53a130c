#include "assets/generator/scalp.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include "assets/generator/bust.h"
#include "assets/generator/random.h"
#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// The crown, from which hair behind the parting radiates.
constexpr dvec3 kCrown{0.012, 0.108, -0.048};

/// Where the parting runs: x on the scalp by depth.
double parting_x(double z) {
    return 0.024 - 0.012 * smoothstep(0.05, -0.05, z);
}

/// Within a centimetre of the parting, or on the crown.
bool beside_parting(const Root& root) {
    const bool parted = std::abs(root.from_parting) < 0.008 && root.position.z > -0.05;
    const bool crown = glm::distance(root.position, dvec3(0.012, 0.113, -0.042)) < 0.018;
    return root.position.y > 0.05 && (parted || crown);
}

dvec3 comb_direction(dvec3 p, dvec3 normal, double from_parting) {
    const double side = from_parting < 0.0 ? -1.0 : 1.0;
    const double front = smoothstep(-0.055, 0.015, p.z);
    const dvec3 parted(side, -0.10, -0.22 - 0.5 * smoothstep(0.055, 0.08, p.z));
    const dvec3 crown(18.0 * (p.x - kCrown.x), -0.2, -0.9);
    dvec3 pull = glm::mix(crown, parted, front);
    // Below the crown hair is combed down.
    pull.y -= 2.2 * smoothstep(0.085, 0.025, p.y) * (1.0 - front);
    return glm::normalize(pull - normal * glm::dot(normal, pull) + dvec3(0.0, -1e-3, 0.0));
}

/// The root where a ray from inside the skull leaves the scalp; nothing off the scalp.
std::optional<Root> root_along(dvec3 direction, uint32_t key) {
    dvec3 p(0.0, 0.025, -0.014);
    for (int step = 0; step < 32; ++step) {
        p -= direction * (skull_distance(p) * 0.9);
    }
    // The hairline thins out over a few millimetres; under the ears nothing grows.
    if (above_hairline(p) < 0.006 * random(key, 4) || skin_distance(p) < -0.0025) {
        return std::nullopt;
    }
    p = push_out(skin_distance, p, 0.0);
    const dvec3 normal = normal_of(skull_distance, p);
    const double from_parting = p.x - parting_x(p.z) + 0.0022 * spread(key, 8);
    return Root{p - normal * 0.0006, normal, comb_direction(p, normal, from_parting), from_parting};
}

}  // namespace

// Roots take the directions of a Fibonacci lattice. Where the hair parts the scalp would show:
// there a second, finer lattice adds to them.
std::vector<Root> make_roots(uint32_t directions) {
    // The golden angle as a rotation, so that no trigonometry is called.
    constexpr double kCos = -0.73736887807831985597;
    constexpr double kSin = 0.67549029426152362721;
    std::vector<Root> roots;
    for (uint32_t lattice = 0; lattice < 2; ++lattice) {
        const uint32_t count = directions * (1 + 2 * lattice);
        glm::dvec2 turn(1.0, 0.0);
        for (uint32_t i = 0; i < count; ++i) {
            turn = glm::normalize(
                glm::dvec2(turn.x * kCos - turn.y * kSin, turn.x * kSin + turn.y * kCos));
            const uint32_t key = lattice * directions + i;
            const double y = 1.0 - 2.0 * (i + 0.5) / count;
            const double r = std::sqrt(1.0 - y * y);
            const dvec3 jitter(spread(key, 1), spread(key, 2), spread(key, 3));
            const std::optional<Root> root =
                root_along(glm::normalize(dvec3(turn.x * r, y, turn.y * r) + jitter * 0.012), key);
            if (root && (lattice == 0 || beside_parting(*root))) {
                roots.push_back(*root);
            }
        }
    }
    return roots;
}

}  // namespace vellus::sculpt
