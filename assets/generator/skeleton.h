#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

namespace vellus::sculpt {

/// A joint at rest: all joints are turned like the model, so a position says everything.
struct Joint {
    const char* name;
    /// Index of an earlier joint; -1 for the first.
    int parent;
    /// Metres, in the model's space.
    glm::dvec3 position;
};

/// How a skeleton stands: rotations in the parents' frames and the place of the first joint.
struct Pose {
    std::vector<glm::dquat> rotations;
    glm::dvec3 root{0.0};
};

/// The pose in which the model was sculpted.
Pose rest_pose(std::span<const Joint> joints);

/// A joint's place and turn in the model's space.
struct Frame {
    glm::dquat rotation;
    glm::dvec3 position;
};

std::vector<Frame> frames_of(std::span<const Joint> joints, const Pose& pose);

/// Four joints that move a vertex and their shares, largest first; the shares add up to 1.
struct Influences {
    std::array<uint8_t, 4> joints{};
    std::array<double, 4> weights{};
};

/// The four largest of one share per joint.
Influences strongest(std::span<const double> shares);

/// Hands a point's movement down the tree: `passed_on[j]` is the share in [0, 1] of what joint j's
/// parent holds that goes to j. Shares of siblings that add up to more than 1 are scaled down.
std::vector<double> shares_down(std::span<const Joint> joints, std::span<const double> passed_on);

/// A point of the model moved by a pose (linear blend skinning).
glm::dvec3 skinned(std::span<const Joint> joints, std::span<const Frame> frames,
                   const Influences& influences, glm::dvec3 point);

/// Two bones from `from` to `to`: turns both so that the middle joint bends towards `pole`.
struct Limb {
    glm::dquat upper, lower;
};

/// Rest places of the three joints, where first and last shall be, and where the middle one points.
/// The hinge lies along the model's X axis at rest. Out of reach, the limb is stretched towards
/// `to`.
Limb reach(const std::array<glm::dvec3, 3>& rest, glm::dvec3 from, glm::dvec3 to, glm::dvec3 pole);

}  // namespace vellus::sculpt
