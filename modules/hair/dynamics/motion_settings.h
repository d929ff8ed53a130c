#pragma once

#include <glm/glm.hpp>

namespace vellus::hair {

/// How strands give way: what an artist sets. See assets/schema/VELLUS_hair.schema.json, "motion".
struct MotionSettings {
    /// Metres of strand that bend under their own weight: (EI / (mass per metre · 9.81))^(1/3),
    /// Peirce's bending length. Single human hair 0.05, a stiff bob 0.15; [0.001, 2].
    float bend_length = 0.07f;
    /// Stiffness against twist over that against bending; 0.75 for a round fibre; [0.05, 10].
    float twist = 0.75f;
    /// Seconds: bending at a rate of 1/damping resists as much as the bend itself; [0, 2].
    float damping = 0.12f;
    /// 1/s: how fast strands take on the speed of the air; [0, 100].
    float drag = 2.5f;
    /// Springs from every link to its groomed direction at the root, against the moment of the
    /// strand's weight: what neighbours and hair spray do; [0, 100].
    float hold = 0.3f;
    /// 1/s: how fast strands on a collider take on its speed; [0, 1000].
    float friction = 15.0f;
    /// Share of the wind that reaches the strands; [0, 10].
    float wind = 1.0f;
    /// Factor on gravity; [-10, 10].
    float gravity = 1.0f;

    bool operator==(const MotionSettings&) const = default;
};

/// The air of the scene. Resource.
struct Wind {
    glm::vec3 velocity{0.0f};  ///< m/s
    float gust = 0.5f;         ///< how much gusts add to and take from it, 0 to 1
};

}  // namespace vellus::hair
