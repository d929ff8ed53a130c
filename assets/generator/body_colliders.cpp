#include "assets/generator/body_colliders.h"

namespace vellus::sculpt {

std::vector<BodyCapsule> body_capsules() {
    std::vector<BodyCapsule> capsules = {
        {"crown", BodyPart::kHead, {0.0, 0.043, -0.034}, {0.0, 0.041, 0.012}, 0.0680},
        {"skull", BodyPart::kHead, {0.0, 0.026, -0.036}, {0.0, 0.029, 0.006}, 0.0710},
        {"nape", BodyPart::kHead, {0.0, -0.010, -0.035}, {0.0, -0.005, 0.010}, 0.0590},
        {"face", BodyPart::kHead, {0.0, 0.002, 0.027}, {0.0, -0.060, 0.033}, 0.0500},
        {"jaw", BodyPart::kHead, {0.0, -0.055, 0.040}, {0.0, -0.088, 0.054}, 0.0300},
        {"neck", BodyPart::kNeck, {0.0, -0.070, -0.023}, {0.0, -0.215, -0.048}, 0.0440},
        {"back", BodyPart::kTorso, {-0.060, -0.345, -0.050}, {0.060, -0.345, -0.050}, 0.0850},
        {"collar", BodyPart::kTorso, {-0.070, -0.264, -0.024}, {0.070, -0.264, -0.024}, 0.0320},
        {"blades", BodyPart::kTorso, {-0.045, -0.270, -0.075}, {0.045, -0.270, -0.075}, 0.0430},
    };
    const auto add_pair = [&](const char* left, const char* right, BodyPart left_part,
                              BodyPart right_part, glm::dvec3 from, glm::dvec3 to, double radius) {
        const glm::dvec3 mirror(-1.0, 1.0, 1.0);
        capsules.push_back({left, left_part, from, to, radius});
        capsules.push_back({right, right_part, mirror * from, mirror * to, radius});
    };
    add_pair("ear_l", "ear_r", BodyPart::kHead, BodyPart::kHead, {0.069, 0.006, -0.011},
             {0.069, -0.030, -0.018}, 0.0085);
    add_pair("slope_l", "slope_r", BodyPart::kTorso, BodyPart::kTorso, {0.016, -0.152, -0.056},
             {0.118, -0.246, -0.058}, 0.0325);
    add_pair("shoulder_l", "shoulder_r", BodyPart::kTorso, BodyPart::kTorso,
             {0.040, -0.260, -0.049}, {0.142, -0.269, -0.052}, 0.0450);
    add_pair("breast_l", "breast_r", BodyPart::kTorso, BodyPart::kTorso, {0.064, -0.385, 0.015},
             {0.055, -0.310, -0.015}, 0.0520);
    return capsules;
}

Json collider_node(const BodyCapsule& capsule, glm::dvec3 joint_at) {
    Json collider = {{"radius", tidy(capsule.radius)}};
    if (capsule.to != capsule.from) collider["to"] = list(capsule.to - capsule.from);
    return {{"name", std::string("collider_") + capsule.name},
            {"translation", list(capsule.from - joint_at)},
            {"extensions", {{"VELLUS_collider", std::move(collider)}}}};
}

}  // namespace vellus::sculpt
