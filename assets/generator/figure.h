#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "assets/generator/skeleton.h"

// A standing person, metres, Y up, soles on y = 0, face towards +Z, arms held off the body; the
// person's left is x > 0. Head and neck are the bust's.
namespace vellus::sculpt {

/// The bust's origin, the middle of the head, in the figure's space.
constexpr glm::dvec3 kHeadMiddle{0.0, 1.545, 0.050};

enum FigureJoint : int {
    kHips,
    kSpine,
    kChest,
    kNeck,
    kHead,
    kLeftShoulder,
    kLeftArm,
    kLeftForearm,
    kLeftHand,
    kRightShoulder,
    kRightArm,
    kRightForearm,
    kRightHand,
    kLeftThigh,
    kLeftShin,
    kLeftFoot,
    kLeftToes,
    kRightThigh,
    kRightShin,
    kRightFoot,
    kRightToes,
    kFigureJoints
};

std::span<const Joint, kFigureJoints> figure_joints();

/// Unit vector from the left shoulder to the left hand at rest.
glm::dvec3 arm_direction();

/// Which joints move a point of the figure.
Influences figure_influences(glm::dvec3 p);

/// Skin that shows: head, neck and collar, arms and hands.
double figure_skin(glm::dvec3 p);
/// A top with short sleeves and a round neckline.
double figure_shirt(glm::dvec3 p);
double figure_trousers(glm::dvec3 p);
double figure_shoes(glm::dvec3 p);

glm::dvec3 figure_skin_color(glm::dvec3 p);
/// Shades of white, to be multiplied by the material's colour.
glm::dvec3 shirt_shade(glm::dvec3 p);
glm::dvec3 trousers_shade(glm::dvec3 p);
glm::dvec3 shoes_shade(glm::dvec3 p);

}  // namespace vellus::sculpt
