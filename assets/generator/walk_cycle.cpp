#include "assets/generator/walk_cycle.h"

#include <cmath>

#include "assets/generator/figure.h"
#include "assets/generator/sdf.h"
#include "assets/generator/trigonometry.h"

// Feet are placed first: planted while they carry, swung along a cubic in between. Hips follow both
// feet, legs reach from hips to feet, chest and arms swing against the hips (Perry, "Gait
// Analysis", 1992, for the times and angles of foot, hips and shoulders).
namespace vellus::sculpt {

namespace {

using glm::dquat;
using glm::dvec3;

constexpr double kFlatFrom = 0.09;
constexpr double kFlatUntil = 0.34;
/// Middle of the stance, when the foot is below the hip.
constexpr double kUnderHip = 0.275;
constexpr double kStrikePitch = -17.0;
constexpr double kToeOffPitch = 54.0;
/// Feet tread closer together than they stand.
constexpr double kTrack = 0.062;
constexpr double kToeOut = 5.0;
/// Height of the rolling edges of the sole over the ground.
constexpr dvec3 kHeelEdge{0.0, 0.004, -0.070};

const Joint& joint(int index) {
    return figure_joints()[static_cast<size_t>(index)];
}

/// Degrees the toes point down while the foot carries; 0: flat.
double stance_pitch(double phase) {
    if (phase < kFlatFrom) {
        const double t = 1.0 - phase / kFlatFrom;
        return kStrikePitch * t * t;
    }
    if (phase < kFlatUntil) {
        return 0.0;
    }
    const double t = (phase - kFlatUntil) / (kStance - kFlatUntil);
    return kToeOffPitch * t * t * (1.55 - 0.55 * t);
}

/// A foot in the moving frame.
struct Tread {
    dvec3 ankle;
    double pitch;
    double yaw;
    /// Degrees the toes bend up against the foot.
    double toes;
};

/// Degrees the moving frame turns left in `strides`.
double turned(const Gait& gait, double strides) {
    return gait.turn_radius == 0.0
               ? 0.0
               : strides * gait.stride_metres / gait.turn_radius * 57.29577951308232;
}

/// While the foot carries, it turns over heel and ball, both fixed on the ground.
Tread stance(const Gait& gait, double side, double phase) {
    const double since = phase - kUnderHip;
    const double pitch = stance_pitch(phase);
    const double yaw = side * kToeOut - turned(gait, since);
    const dvec3 under(side * kTrack, 0.0, 0.010);
    const dvec3 at = ground_after(gait, under, since);
    const dvec3 ankle_at(0.0, joint(kLeftFoot).position.y, joint(kLeftFoot).position.z);
    const dvec3 ball(0.0, joint(kLeftToes).position.y, joint(kLeftToes).position.z);
    const dvec3 edge = pitch < 0.0 ? kHeelEdge : ball;
    const dvec3 rolled = edge + turn_about({1.0, 0.0, 0.0}, pitch) * (ankle_at - edge);
    return {at + turn_about({0.0, 1.0, 0.0}, yaw) * rolled, pitch, yaw, std::max(pitch, 0.0)};
}

double hermite(double a, double slope_a, double b, double slope_b, double t) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return a * (2 * t3 - 3 * t2 + 1) + slope_a * (t3 - 2 * t2 + t) + b * (3 * t2 - 2 * t3) +
           slope_b * (t3 - t2);
}

/// From lifting the toes to the heel's landing, with the speeds of both.
Tread swing(const Gait& gait, double side, double phase) {
    constexpr double kLength = 1.0 - kStance;
    constexpr double kEps = 1e-4;
    const double t = (phase - kStance) / kLength;
    const Tread from = stance(gait, side, kStance);
    const Tread before = stance(gait, side, kStance - kEps);
    const Tread to = stance(gait, side, 0.0);
    const Tread after = stance(gait, side, kEps);
    const double scale = kLength / kEps;
    const auto blend = [&](double a, double a0, double b, double b1) {
        return hermite(a, (a - a0) * scale, b, (b1 - b) * scale, t);
    };
    Tread tread{};
    for (int i = 0; i < 3; ++i) {
        tread.ankle[i] = blend(from.ankle[i], before.ankle[i], to.ankle[i], after.ankle[i]);
    }
    // The toes pass a good centimetre over the ground.
    tread.ankle.y += 0.60 * t * t * (1.0 - t) * (1.0 - t) * (1.0 - 0.25 * t);
    // The heel comes down at a slant rather than skimming the ground.
    tread.ankle.y += 0.10 * t * t * t * (1.0 - t);
    tread.pitch = blend(from.pitch, before.pitch, to.pitch, after.pitch);
    tread.yaw = blend(from.yaw, before.yaw, to.yaw, after.yaw);
    // Toes curl up as they leave the ground.
    tread.toes = from.toes * (1.0 - smoothstep(0.12, 0.70, t)) +
                 20.0 * smoothstep(0.0, 0.10, t) * (1.0 - smoothstep(0.12, 0.50, t));
    return tread;
}

Tread tread_at(const Gait& gait, double side, double phase) {
    const double p = phase - std::floor(phase);
    return p < kStance ? stance(gait, side, p) : swing(gait, side, p);
}

void set_leg(Pose& pose, const Frame& hips, int thigh, const Tread& tread) {
    const dvec3 rest_hips = joint(kHips).position;
    const std::array<dvec3, 3> rest = {joint(thigh).position, joint(thigh + 1).position,
                                       joint(thigh + 2).position};
    const dquat heading = turn_about({0.0, 1.0, 0.0}, 0.6 * tread.yaw);
    const Limb leg = reach(rest, hips.position + hips.rotation * (rest[0] - rest_hips), tread.ankle,
                           heading * dvec3(0.0, 0.0, 1.0));
    const dquat foot =
        turn_about({0.0, 1.0, 0.0}, tread.yaw) * turn_about({1.0, 0.0, 0.0}, tread.pitch);
    const auto set = [&](int index, dquat q) { pose.rotations[static_cast<size_t>(index)] = q; };
    set(thigh, glm::inverse(hips.rotation) * leg.upper);
    set(thigh + 1, glm::inverse(leg.upper) * leg.lower);
    set(thigh + 2, glm::inverse(leg.lower) * foot);
    set(thigh + 3, turn_about({1.0, 0.0, 0.0}, -tread.toes));
}

/// The arm from its sculpted pose down to the side, swung forwards by degrees, elbow bent.
void set_arm(Pose& pose, int shoulder, double side, double forward, double bend, double off_body) {
    const dvec3 hanging = glm::normalize(dvec3(side * off_body, -1.0, 0.0));
    const dvec3 aim = turn_about({1.0, 0.0, 0.0}, -forward) * hanging;
    const dvec3 rest(side * arm_direction().x, arm_direction().y, 0.0);
    // The hinge of the elbow turns the forearm forwards; it lies across the arm.
    const dvec3 hinge = glm::cross(rest, dvec3(0.0, 0.0, 1.0));
    const auto at = [&](int index) -> dquat& { return pose.rotations[static_cast<size_t>(index)]; };
    at(shoulder) = turn_about({0.0, 0.0, 1.0}, -side * 4.0);
    const dquat down = rotation_between(glm::inverse(dquat(1.0, 0.0, 0.0, 0.0)) * rest, aim);
    at(shoulder + 1) = glm::inverse(at(shoulder)) * down;
    at(shoulder + 2) = turn_about(hinge, bend);
    at(shoulder + 3) = turn_about(hinge, 6.0);
}

}  // namespace

dvec3 ground_after(const Gait& gait, dvec3 start, double strides) {
    if (gait.turn_radius == 0.0) {
        return start - dvec3(0.0, 0.0, strides * gait.stride_metres);
    }
    const dvec3 center(gait.turn_radius, 0.0, 0.0);
    return center + turn_about({0.0, 1.0, 0.0}, -turned(gait, strides)) * (start - center);
}

Pose walk_pose(const Gait& gait, double phase) {
    Pose pose = rest_pose(figure_joints());
    const Tread left = tread_at(gait, 1.0, phase);
    const Tread right = tread_at(gait, -1.0, phase + 0.5);

    // Low while both feet carry; over the carrying foot; turned towards the foot in front.
    const double step = 2.0 * (phase - 0.06);
    const double side = sine(phase - 0.055);
    const double bank = gait.turn_radius == 0.0 ? 0.0 : 0.012;
    pose.root = {0.020 * side + bank, 0.889 - 0.018 * cosine(step), 0.006 * sine(step)};
    const double yaw = -5.5 * cosine(phase - 0.02);
    const double lean = 3.5 * sine(phase - 0.03);
    const auto at = [&](int index) -> dquat& { return pose.rotations[static_cast<size_t>(index)]; };
    at(kHips) = tilt(3.0 + 0.8 * cosine(step), yaw, -lean);
    const Frame hips{at(kHips), pose.root};
    set_leg(pose, hips, kLeftThigh, left);
    set_leg(pose, hips, kRightThigh, right);

    // The chest turns against the hips, the head keeps facing ahead.
    at(kSpine) = tilt(-1.0, -0.9 * yaw, 0.75 * lean);
    at(kChest) = tilt(0.5 - 0.6 * cosine(step), -0.75 * yaw, 0.55 * lean);
    at(kNeck) = tilt(2.0, 0.35 * yaw, -0.15 * lean);
    at(kHead) = tilt(-3.0 + 0.9 * cosine(step + 0.1), 0.30 * yaw, -0.15 * lean);

    const double swing_left = -cosine(phase - 0.05);
    set_arm(pose, kLeftShoulder, 1.0, 3.0 + 23.0 * swing_left, 20.0 + 13.0 * swing_left, 0.17);
    set_arm(pose, kRightShoulder, -1.0, 3.0 - 23.0 * swing_left, 20.0 - 13.0 * swing_left, 0.17);
    return pose;
}

Pose idle_pose(double phase) {
    Pose pose = rest_pose(figure_joints());
    const double breath = sine(2.0 * phase);
    const double shift = 0.5 + 0.5 * sine(phase);
    pose.root = {0.016 + 0.010 * shift, 0.916 + 0.0015 * breath, -0.004};
    const auto at = [&](int index) -> dquat& { return pose.rotations[static_cast<size_t>(index)]; };
    at(kHips) = tilt(1.5, 3.0, -2.0 - 0.8 * shift);
    const Frame hips{at(kHips), pose.root};
    const dvec3 ankle = joint(kLeftFoot).position;
    set_leg(pose, hips, kLeftThigh, {{0.080, ankle.y, ankle.z}, 0.0, 7.0, 0.0});
    set_leg(pose, hips, kRightThigh, {{-0.108, ankle.y, ankle.z + 0.045}, 0.0, -14.0, 0.0});
    at(kSpine) = tilt(-1.0, -1.5, 1.4 + 0.5 * shift);
    at(kChest) = tilt(-1.0 - 0.7 * breath, -1.5, 0.8);
    at(kNeck) = tilt(2.0, 6.0 * sine(phase + 0.2), 0.5);
    at(kHead) = tilt(-1.0 + 1.5 * sine(phase), 9.0 * sine(phase + 0.17), 1.0);
    set_arm(pose, kLeftShoulder, 1.0, 2.0 + breath, 12.0, 0.095);
    set_arm(pose, kRightShoulder, -1.0, 4.0 + breath, 16.0, 0.105);
    return pose;
}

}  // namespace vellus::sculpt
