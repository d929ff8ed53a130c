#pragma once

#include <glm/glm.hpp>

// A human bust as signed distance fields, metres, Y up, face towards +Z. The origin is the middle
// of the head: between the pupils' height and halfway from crown (y = 0.115) to chin (y = -0.115).
namespace vellus::sculpt {

/// Where the centre of the left eyeball (of the person, x > 0) is; the right one is its mirror
/// image.
constexpr glm::dvec3 kEyeCenter{0.0312, 0.0, 0.0618};
constexpr double kEyeRadius = 0.0150;

/// Skull and jaw alone, without ears, nose and lips: what hair is combed over.
double skull_distance(glm::dvec3 p);

/// The skin: head, neck, shoulders and arms, open at the eyes, flat below.
double skin_distance(glm::dvec3 p);

/// The rim of the left upper lid seen from the front (z is left at the eye's centre), from the
/// inner corner t = -1 to the outer t = 1.
glm::dvec3 upper_lid_rim(double t);

/// The top: a layer of cloth on the shoulders with a round neckline.
double cloth_distance(glm::dvec3 p);

/// Skin and cloth together.
double bust_distance(glm::dvec3 p);

/// How far above the hairline a point of the scalp is, in metres; negative on face and neck.
double above_hairline(glm::dvec3 p);

/// Linear colour of the skin at a point of its surface: blush, lips, shade under hair.
glm::dvec3 skin_color(glm::dvec3 p);

/// Shares of the joints torso, neck and head in the movement of a point; they add up to 1.
glm::dvec3 joint_weights(glm::dvec3 p);

}  // namespace vellus::sculpt
