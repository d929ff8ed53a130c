#pragma once

#include <glm/glm.hpp>
#include <span>

#include "assets/generator/hair_style.h"
#include "assets/generator/part.h"
#include "assets/generator/skeleton.h"

// A young fox, metres, Y up, paws on y = 0, looking along +Z; its left is x > 0.
namespace vellus::sculpt {

enum FoxJoint : int {
    kFoxHips,
    kFoxSpine,
    kFoxChest,
    kFoxNeck,
    kFoxHead,
    kFoxLeftEar,
    kFoxRightEar,
    kFoxTail1,
    kFoxTail2,
    kFoxTail3,
    kFoxTail4,
    kFoxLeftArm,
    kFoxLeftPaw,
    kFoxRightArm,
    kFoxRightPaw,
    kFoxLeftThigh,
    kFoxLeftFoot,
    kFoxRightThigh,
    kFoxRightFoot,
    kFoxJoints
};

std::span<const Joint, kFoxJoints> fox_joints();
Influences fox_influences(glm::dvec3 p);

/// The skin under the fur.
double fox_skin(glm::dvec3 p);
/// Colour of the fur at a point of the skin as sRGB values, the encoding of .hair files.
glm::dvec3 fox_srgb(glm::dvec3 p);

/// Skin, nose and eyes.
std::vector<SkinnedPart> make_fox();

/// Short hair combed over a surface.
struct Fur {
    std::vector<Strand> strands;
    /// sRGB, one per point.
    std::vector<glm::vec4> colors;
};
/// Fur rooted on the skin part of make_fox(), long on tail and cheeks, short on legs and face.
Fur grow_fox_fur(const SkinnedPart& skin);

/// Standing, `phase` of a clip that repeats: it breathes, looks round, swings its tail.
Pose fox_pose(double phase);

}  // namespace vellus::sculpt
