#pragma once

#include <cmath>
#include <random>

#include "modules/hair/groom/strand_data.h"

namespace vellus::hair::test {

/// A lock: strands that start within `radius` around `root`, run along `direction` bent by `bend`,
/// and part towards the tips by `fan`; metres.
struct Lock {
    glm::vec3 root{0.0f};
    glm::vec3 direction{0, -1, 0};
    float length = 0.2f;
    float radius = 0.01f;
    float fan = 1.0f;
    float bend = 0.0f;
    float flatness = 0.2f;  ///< thickness over width
    float curl = 0.0f;      ///< radius of a helix
    float turn = 25.0f;     ///< radians of it
    float phases = 3.0f;    ///< radians by which strands start apart, to either side
    int points = 24;        ///< a strand
};

inline void add_lock(Groom& groom, const Lock& lock, int strands, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> spread(-1.0f, 1.0f);
    for (int s = 0; s < strands; ++s) {
        const float x = spread(random) * lock.radius;
        const float z = spread(random) * lock.radius * lock.flatness;
        const float phase = lock.phases * spread(random);
        const float length = lock.length * (1.0f + 0.1f * spread(random));
        for (int i = 0; i < lock.points; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(lock.points - 1);
            const float wide = 1.0f + (lock.fan - 1.0f) * t;
            const float angle = phase + lock.turn * t;
            groom.points.push_back(
                lock.root + lock.direction * (t * length) +
                glm::vec3(x * wide + lock.curl * std::cos(angle), 0.0f,
                          z * wide + lock.bend * t * t + lock.curl * std::sin(angle)));
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
}

inline StrandData strands_of(const Groom& groom, float width) {
    return prepare_strands(groom, glm::dmat4(1.0), width);
}

}  // namespace vellus::hair::test
