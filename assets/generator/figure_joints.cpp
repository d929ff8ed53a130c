#include "assets/generator/figure.h"
#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr dvec3 kShoulderAt{0.148, 1.272, -0.002};
// Forty degrees below the horizontal: halfway between the poses the arm takes.
constexpr dvec3 kArmDirection{0.7071067811865476, -0.7071067811865476, 0.0};
constexpr double kUpperArm = 0.262;
constexpr double kForearm = 0.225;
constexpr dvec3 kElbowAt = kShoulderAt + kArmDirection * kUpperArm;
constexpr dvec3 kWristAt = kElbowAt + kArmDirection * kForearm;

constexpr dvec3 mirrored(dvec3 p) {
    return {-p.x, p.y, p.z};
}

constexpr dvec3 kCollar{0.022, 1.305, 0.004};
constexpr dvec3 kHip{0.086, 0.870, 0.0};
constexpr dvec3 kKnee{0.086, 0.472, 0.006};
constexpr dvec3 kAnkle{0.086, 0.082, -0.018};
constexpr dvec3 kBall{0.090, 0.024, 0.094};

constexpr std::array<Joint, kFigureJoints> kJoints = {{
    {"hips", -1, {0.0, 0.930, 0.0}},
    {"spine", kHips, {0.0, 1.040, -0.006}},
    {"chest", kSpine, {0.0, 1.165, -0.010}},
    {"neck", kChest, {0.0, 1.370, 0.000}},
    {"head", kNeck, {0.0, 1.462, 0.024}},
    {"shoulder_l", kChest, kCollar},
    {"arm_l", kLeftShoulder, kShoulderAt},
    {"forearm_l", kLeftArm, kElbowAt},
    {"hand_l", kLeftForearm, kWristAt},
    {"shoulder_r", kChest, mirrored(kCollar)},
    {"arm_r", kRightShoulder, mirrored(kShoulderAt)},
    {"forearm_r", kRightArm, mirrored(kElbowAt)},
    {"hand_r", kRightForearm, mirrored(kWristAt)},
    {"thigh_l", kHips, kHip},
    {"shin_l", kLeftThigh, kKnee},
    {"foot_l", kLeftShin, kAnkle},
    {"toes_l", kLeftFoot, kBall},
    {"thigh_r", kHips, mirrored(kHip)},
    {"shin_r", kRightThigh, mirrored(kKnee)},
    {"foot_r", kRightShin, mirrored(kAnkle)},
    {"toes_r", kRightFoot, mirrored(kBall)},
}};

/// 0 before the joint, 1 beyond it, along `direction`, over `width` metres on either side.
double beyond(dvec3 p, dvec3 joint, dvec3 direction, double width) {
    return smoothstep(-width, width, glm::dot(p - joint, direction));
}

/// 1 on the axis of the left arm, 0 on the side of the chest.
double near_arm(dvec3 q) {
    const dvec3 from = q - kShoulderAt;
    const dvec3 across = from - kArmDirection * glm::dot(from, kArmDirection);
    return 1.0 - smoothstep(0.070, 0.125, glm::length(across));
}

}  // namespace

std::span<const Joint, kFigureJoints> figure_joints() {
    return kJoints;
}

dvec3 arm_direction() {
    return kArmDirection;
}

Influences figure_influences(dvec3 p) {
    const dvec3 up(0.0, 1.0, 0.0);
    const dvec3 down(0.0, -1.0, 0.0);
    std::array<double, kFigureJoints> on{};
    // The arms hang on the chest however low they reach.
    const double off_body = smoothstep(0.205, 0.255, std::abs(p.x));
    on[kSpine] = std::max(off_body, beyond(p, {0.0, 1.020, 0.0}, up, 0.075));
    on[kChest] = std::max(off_body, beyond(p, {0.0, 1.140, 0.0}, up, 0.075));
    // The neck bends along a plane that rises towards the nape, as the bust's does.
    const double along = p.y - kHeadMiddle.y + 0.5 * (p.z - kHeadMiddle.z + 0.02);
    on[kHead] = smoothstep(-0.155, -0.088, along);
    on[kNeck] = std::max(on[kHead], smoothstep(-0.255, -0.165, along));
    for (const int side : {0, 1}) {
        const dvec3 q(side == 0 ? p.x : -p.x, p.y, p.z);
        // Each right limb follows its left one by four joints.
        const auto joint = [&](int left) {
            return static_cast<size_t>(left) + size_t{4} * static_cast<size_t>(side);
        };
        const double arm = near_arm(q);
        on[joint(kLeftShoulder)] =
            std::max(smoothstep(0.030, 0.110, q.x) * smoothstep(1.150, 1.270, p.y) *
                         (1.0 - smoothstep(-0.255, -0.190, along)),
                     arm * beyond(q, kShoulderAt, kArmDirection, 0.055));
        on[joint(kLeftArm)] = arm * beyond(q, kShoulderAt, kArmDirection, 0.055);
        on[joint(kLeftForearm)] = beyond(q, kElbowAt, kArmDirection, 0.038);
        on[joint(kLeftHand)] = beyond(q, kWristAt, kArmDirection, 0.022);
        // Thighs part at the middle and fold along a plane that rises outwards.
        const dvec3 groin = glm::normalize(dvec3(0.35, -1.0, 0.12));
        on[joint(kLeftThigh)] = (1.0 - off_body) * smoothstep(-0.016, 0.016, q.x) *
                                beyond(q, kHip - up * 0.01, groin, 0.062);
        on[joint(kLeftShin)] = beyond(q, kKnee, down, 0.050);
        on[joint(kLeftFoot)] = smoothstep(0.030, -0.030, q.y - kAnkle.y + 0.55 * (kAnkle.z - q.z));
        on[joint(kLeftToes)] = smoothstep(-0.016, 0.016, q.z - kBall.z);
    }
    return strongest(shares_down(kJoints, on));
}

}  // namespace vellus::sculpt
