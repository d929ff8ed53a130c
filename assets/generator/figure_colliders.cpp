#include "assets/generator/figure_colliders.h"

#include <array>

#include "assets/generator/body_colliders.h"
#include "assets/generator/figure.h"

namespace vellus::sculpt {

void add_figure_colliders(GltfScene& scene, const Rig& rig) {
    std::vector<BodyCapsule> capsules = body_capsules();
    for (BodyCapsule& capsule : capsules) {
        capsule.from += kHeadMiddle;
        capsule.to += kHeadMiddle;
    }
    const auto joint = [](FigureJoint index) { return figure_joints()[index].position; };
    capsules.push_back({"arm_l", BodyPart::kLeftArm, joint(kLeftArm), joint(kLeftForearm), 0.0450});
    capsules.push_back(
        {"arm_r", BodyPart::kRightArm, joint(kRightArm), joint(kRightForearm), 0.0450});
    // In the order of BodyPart.
    constexpr std::array<FigureJoint, 5> kJointOf = {kHead, kNeck, kChest, kLeftArm, kRightArm};
    for (const BodyCapsule& capsule : capsules) {
        const FigureJoint at = kJointOf[static_cast<size_t>(capsule.part)];
        scene.add_collider(capsule, joint(at), rig.nodes[at]);
    }
}

}  // namespace vellus::sculpt
