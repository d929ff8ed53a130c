#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "assets/generator/gltf_values.h"

namespace vellus::sculpt {

/// What a collider goes along with; the figure and the bust have joints for each.
enum class BodyPart { kHead, kNeck, kTorso, kLeftArm, kRightArm };

/// A capsule that moving hair stays out of, in the bust's space; a sphere where both ends are one.
struct BodyCapsule {
    const char* name;
    BodyPart part;
    glm::dvec3 from, to;
    double radius;
};

/// Head, neck and torso as capsules a few millimetres inside the skin.
std::vector<BodyCapsule> body_capsules();

/// A glTF node with VELLUS_collider, below a joint at `joint_at`.
Json collider_node(const BodyCapsule& capsule, glm::dvec3 joint_at);

}  // namespace vellus::sculpt
