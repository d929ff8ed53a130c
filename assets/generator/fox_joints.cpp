#include "assets/generator/fox.h"
#include "assets/generator/sdf.h"
#include "assets/generator/trigonometry.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr std::array<Joint, kFoxJoints> kJoints = {{
    {"hips", -1, {0.0, 0.360, -0.170}},
    {"spine", kFoxHips, {0.0, 0.375, -0.050}},
    {"chest", kFoxSpine, {0.0, 0.375, 0.080}},
    {"neck", kFoxChest, {0.0, 0.405, 0.175}},
    {"head", kFoxNeck, {0.0, 0.510, 0.265}},
    {"ear_l", kFoxHead, {0.044, 0.585, 0.285}},
    {"ear_r", kFoxHead, {-0.044, 0.585, 0.285}},
    {"tail_1", kFoxHips, {0.0, 0.375, -0.235}},
    {"tail_2", kFoxTail1, {0.0, 0.338, -0.340}},
    {"tail_3", kFoxTail2, {0.0, 0.300, -0.430}},
    {"tail_4", kFoxTail3, {0.0, 0.280, -0.510}},
    {"arm_l", kFoxChest, {0.060, 0.310, 0.122}},
    {"paw_l", kFoxLeftArm, {0.066, 0.050, 0.132}},
    {"arm_r", kFoxChest, {-0.060, 0.310, 0.122}},
    {"paw_r", kFoxRightArm, {-0.066, 0.050, 0.132}},
    {"thigh_l", kFoxHips, {0.055, 0.310, -0.170}},
    {"foot_l", kFoxLeftThigh, {0.070, 0.040, -0.205}},
    {"thigh_r", kFoxHips, {-0.055, 0.310, -0.170}},
    {"foot_r", kFoxRightThigh, {-0.070, 0.040, -0.205}},
}};

double beyond(dvec3 p, dvec3 joint, dvec3 direction, double width) {
    return smoothstep(-width, width, glm::dot(p - joint, glm::normalize(direction)));
}

}  // namespace

std::span<const Joint, kFoxJoints> fox_joints() {
    return kJoints;
}

Influences fox_influences(dvec3 p) {
    std::array<double, kFoxJoints> on{};
    const auto at = [](int joint) { return kJoints[static_cast<size_t>(joint)].position; };
    const dvec3 back(0.0, -0.30, -1.0);
    on[kFoxSpine] = smoothstep(-0.110, 0.010, p.z);
    on[kFoxChest] = smoothstep(0.010, 0.120, p.z);
    on[kFoxNeck] = beyond(p, {0.0, 0.425, 0.195}, {0.0, 0.75, 0.65}, 0.050);
    on[kFoxHead] = beyond(p, {0.0, 0.495, 0.262}, {0.0, 0.60, 0.80}, 0.032);
    // Hind paws reach as far back as the root of the tail, lower down.
    on[kFoxTail1] = beyond(p, at(kFoxTail1), back, 0.030) * smoothstep(-0.240, -0.275, p.z);
    on[kFoxTail2] = beyond(p, at(kFoxTail2), back, 0.045);
    on[kFoxTail3] = beyond(p, at(kFoxTail3), back, 0.045);
    on[kFoxTail4] = beyond(p, at(kFoxTail4), back, 0.040);
    for (const int side : {0, 1}) {
        const dvec3 q(side == 0 ? p.x : -p.x, p.y, p.z);
        const auto joint = [&](int left, int step) {
            return static_cast<size_t>(left) +
                   static_cast<size_t>(side) * static_cast<size_t>(step);
        };
        const double half = smoothstep(-0.010, 0.010, q.x);
        on[joint(kFoxLeftEar, 1)] = half * beyond(q, {0.046, 0.592, 0.285}, {0.2, 1.0, 0.0}, 0.014);
        on[joint(kFoxLeftArm, 2)] = half * beyond(q, {0.0, 0.255, 0.0}, {0.0, -1.0, 0.0}, 0.050) *
                                    smoothstep(0.0, 0.06, q.z);
        on[joint(kFoxLeftPaw, 2)] = beyond(q, {0.0, 0.050, 0.0}, {0.0, -1.0, 0.0}, 0.018);
        on[joint(kFoxLeftThigh, 2)] = half * beyond(q, {0.0, 0.255, 0.0}, {0.0, -1.0, 0.0}, 0.055) *
                                      smoothstep(0.0, -0.05, q.z) * smoothstep(-0.30, -0.26, q.z);
        on[joint(kFoxLeftFoot, 2)] = beyond(q, {0.0, 0.045, 0.0}, {0.0, -1.0, 0.0}, 0.018);
    }
    return strongest(shares_down(kJoints, on));
}

Pose fox_pose(double phase) {
    Pose pose = rest_pose(kJoints);
    const auto at = [&](int joint) -> glm::dquat& {
        return pose.rotations[static_cast<size_t>(joint)];
    };
    const double breath = sine(4.0 * phase);
    // It looks left, then right, and quickly back.
    const double look = sine(phase) + 0.35 * sine(2.0 * phase + 0.1);
    at(kFoxSpine) = tilt(0.35 * breath, 0.0, 0.0);
    at(kFoxChest) = tilt(-0.6 * breath, 0.0, 0.0);
    at(kFoxNeck) = tilt(2.0 + 2.0 * sine(2.0 * phase + 0.3), 11.0 * look, 0.0);
    at(kFoxHead) =
        tilt(-2.0 + 3.5 * sine(2.0 * phase + 0.15), 14.0 * look, 5.0 * sine(phase + 0.35));
    const double flick = smoothstep(0.60, 0.62, phase) * smoothstep(0.68, 0.64, phase);
    at(kFoxLeftEar) = tilt(-4.0, 14.0 * flick + 4.0 * look, -10.0 * flick);
    at(kFoxRightEar) = tilt(-4.0, 4.0 * look, 0.0);
    for (int joint = kFoxTail1; joint <= kFoxTail4; ++joint) {
        const double along = joint - kFoxTail1;
        at(joint) = tilt(4.0 * sine(phase * 2.0 - 0.10 * along + 0.4) + 5.0,
                         (7.0 + 4.0 * along) * sine(2.0 * phase - 0.11 * along), 0.0);
    }
    // Legs stand while hips and chest move: turned back against what carries them.
    const glm::dquat chest = at(kFoxSpine) * at(kFoxChest);
    for (const int arm : {kFoxLeftArm, kFoxRightArm}) {
        at(arm) = glm::inverse(chest);
    }
    return pose;
}

}  // namespace vellus::sculpt
