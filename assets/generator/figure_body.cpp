#include "assets/generator/bust.h"
#include "assets/generator/figure.h"
#include "assets/generator/random.h"
#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// The figure is symmetric: everything is sculpted at x >= 0.
dvec3 mirror(dvec3 p) {
    return {std::abs(p.x), p.y, p.z};
}

dvec3 at_joint(int joint) {
    return figure_joints()[static_cast<size_t>(joint)].position;
}

double chest(dvec3 q) {
    double d = ellipsoid(q, {0.0, 1.190, 0.000}, {0.1360, 0.1500, 0.0900});
    d = join(d, capsule(q, {0.040, 1.290, -0.004}, {0.140, 1.277, -0.002}, 0.0420, 0.0420), 0.040);
    d = join(d, capsule(q, {0.018, 1.415, -0.010}, {0.112, 1.302, -0.010}, 0.0240, 0.0280), 0.045);
    d = join(d, capsule(q, {0.0, 1.475, 0.027}, {0.0, 1.330, 0.002}, 0.0435, 0.0470), 0.040);
    return join(d, ellipsoid(q, {0.062, 1.166, 0.064}, {0.0600, 0.0630, 0.0470}), 0.045);
}

double waist_and_hips(dvec3 q) {
    double d = ellipsoid(q, {0.0, 1.045, 0.002}, {0.1130, 0.1500, 0.0790});
    d = join(d, ellipsoid(q, {0.0, 0.925, -0.002}, {0.1520, 0.1000, 0.1000}), 0.060);
    d = join(d, ellipsoid(q, {0.070, 0.880, -0.045}, {0.0740, 0.0800, 0.0680}), 0.040);
    return d;
}

double arm(dvec3 q) {
    const dvec3 shoulder = at_joint(kLeftArm);
    const dvec3 elbow = at_joint(kLeftForearm);
    const dvec3 wrist = at_joint(kLeftHand);
    double d = capsule(q, shoulder, elbow, 0.0430, 0.0330);
    d = join(d, capsule(q, elbow, wrist, 0.0345, 0.0235), 0.020);
    // The bulk of the forearm lies below the elbow.
    const dvec3 bulk = glm::mix(elbow, wrist, 0.26);
    return join(d, sphere(q, bulk, 0.0350), 0.040);
}

/// Palm and slightly curled fingers; the thumb points forwards, the palm to the body.
double hand(dvec3 q) {
    const dvec3 along = arm_direction();
    const dvec3 palm(along.y, -along.x, 0.0);
    const dvec3 wrist = at_joint(kLeftHand);
    const auto at = [&](double out, double forward, double inward) {
        return wrist + along * out + dvec3(0.0, 0.0, forward) + palm * inward;
    };
    double d = capsule(q, at(0.010, 0.000, 0.000), at(0.060, 0.004, 0.002), 0.0205, 0.0190);
    d = join(d, capsule(q, at(0.055, -0.014, 0.002), at(0.070, 0.020, 0.003), 0.0150, 0.0150),
             0.016);
    struct Finger {
        double forward, length;
    };
    for (const Finger finger : {Finger{0.0215, 0.066}, Finger{0.0075, 0.075},
                                Finger{-0.0065, 0.070}, Finger{-0.0195, 0.057}}) {
        const dvec3 knuckle = at(0.072, finger.forward * 0.92, 0.003);
        const dvec3 bend = at(0.072 + 0.55 * finger.length, finger.forward, 0.009);
        const dvec3 tip = at(0.068 + 0.95 * finger.length, finger.forward * 0.95, 0.026);
        double f = capsule(q, knuckle, bend, 0.0094, 0.0088);
        f = join(f, capsule(q, bend, tip, 0.0088, 0.0080), 0.004);
        d = join(d, f, 0.010);
    }
    double thumb = capsule(q, at(0.020, 0.014, 0.006), at(0.052, 0.038, 0.016), 0.0135, 0.0100);
    thumb = join(
        thumb, capsule(q, at(0.052, 0.038, 0.016), at(0.082, 0.042, 0.022), 0.0100, 0.0080), 0.006);
    return join(d, thumb, 0.014);
}

double leg(dvec3 q) {
    const dvec3 hip = at_joint(kLeftThigh);
    const dvec3 knee = at_joint(kLeftShin);
    const dvec3 ankle = at_joint(kLeftFoot);
    double d = capsule(q, hip - dvec3(0.0, 0.010, 0.0), knee, 0.0820, 0.0520);
    d = join(d, capsule(q, knee, ankle, 0.0500, 0.0330), 0.030);
    return join(d, ellipsoid(q, {0.086, 0.345, -0.020}, {0.0480, 0.1150, 0.0500}), 0.040);
}

/// Distance along the arm from the shoulder.
double along_arm(dvec3 q) {
    return glm::dot(q - at_joint(kLeftArm), arm_direction());
}

/// Slack and folds of cloth, a few millimetres.
double folds(dvec3 p, double period, double depth, uint32_t salt) {
    return depth * noise(p, period, salt);
}

constexpr double kSleeve = 0.150;

/// What the neckline cuts out of the top: a tube around the neck, wider in front.
double neckline(dvec3 p) {
    const double tube = capsule(p, {0.0, 1.560, 0.040}, {0.0, 1.375, -0.004}, 0.0740, 0.0700);
    return join(tube, ellipsoid(p, {0.0, 1.345, 0.070}, {0.0720, 0.0600, 0.0800}), 0.030);
}

}  // namespace

double figure_skin(dvec3 p) {
    const dvec3 q = mirror(p);
    // Below the collar the shirt hides everything.
    const dvec3 b = p - kHeadMiddle;
    double d = 1e9;
    if (q.y > 1.20 && q.x < 0.25) {
        const double collar =
            std::min(-0.165 - b.y, ellipsoid(b, {0.0, -0.190, -0.030}, {0.1250, 0.1000, 0.1050}));
        d = meet(skin_distance(b), collar, 0.010);
    }
    if (q.x > 0.15) {
        const double limb = join(arm(q), hand(q), 0.014);
        d = std::min(d, meet(limb, kSleeve - 0.045 - along_arm(q), 0.010));
    }
    return d;
}

double figure_shirt(dvec3 p) {
    const dvec3 q = mirror(p);
    double d = join(chest(q), join(waist_and_hips(q), leg(q), 0.045), 0.070);
    // The cloth hangs from chest to hip rather than following the waist.
    d = join(d, ellipsoid(q, {0.0, 1.040, 0.006}, {0.1260, 0.1900, 0.0880}), 0.050);
    const double sleeve = capsule(q, at_joint(kLeftArm), at_joint(kLeftForearm), 0.0480, 0.0500);
    d = join(d, meet(sleeve, along_arm(q) - kSleeve, 0.006), 0.045);
    const double low = smoothstep(1.12, 0.94, q.y);
    d -= 0.0075 + 0.0060 * low + folds(p, 0.17, 0.0018 + 0.0030 * low, 71);
    d = carve(d, neckline(p), 0.008);
    const double hem =
        0.905 + 0.012 * smoothstep(0.0, 0.14, q.x) - 0.008 * smoothstep(0.0, -0.1, q.z);
    return meet(d, hem - p.y, 0.008);
}

double figure_trousers(dvec3 p) {
    const dvec3 q = mirror(p);
    double d = join(waist_and_hips(q), leg(q), 0.045);
    // A straight cut hides calf and ankle.
    const double low = smoothstep(0.50, 0.16, q.y);
    d = join(d, capsule(q, {0.087, 0.470, 0.000}, {0.088, 0.090, -0.008}, 0.0540, 0.0560), 0.030);
    d -= 0.0045 + 0.0020 * low + folds(p, 0.13, 0.0016 + 0.0016 * low, 73);
    // The legs stay apart.
    d = carve(d, std::max(q.x - 0.006, q.y - 0.800), 0.020);
    d = meet(d, p.y - 0.985, 0.008);
    return meet(d, 0.062 + 0.20 * std::max(0.0, -0.010 - q.z) - p.y, 0.008);
}

double figure_shoes(dvec3 p) {
    const dvec3 q = mirror(p);
    const auto at = [](double x, double y, double z) { return dvec3(0.089 + x, y, z); };
    double d = capsule(q, at(0.000, 0.034, -0.044), at(0.004, 0.030, 0.090), 0.0300, 0.0340);
    d = join(d, ellipsoid(q, at(0.002, 0.024, 0.112), {0.0400, 0.0300, 0.0580}), 0.030);
    d = join(d, capsule(q, at(-0.001, 0.050, -0.030), at(-0.001, 0.098, -0.022), 0.0330, 0.0330),
             0.024);
    d = join(d, capsule(q, at(0.000, 0.070, 0.000), at(0.002, 0.040, 0.080), 0.0240, 0.0220),
             0.020);
    // The sole: a plate with a rim.
    const double outline =
        std::min(ellipsoid({q.x, 0.0, q.z}, at(0.003, 0.0, 0.075), {0.0425, 1.0, 0.0980}),
                 ellipsoid({q.x, 0.0, q.z}, at(-0.001, 0.0, -0.030), {0.0350, 1.0, 0.0520}));
    const double sole = meet(outline, std::max(p.y - 0.020, -p.y), 0.006);
    d = std::min(meet(d, 0.004 - p.y, 0.004), sole);
    return meet(d, p.y - 0.104, 0.010);
}

dvec3 figure_skin_color(dvec3 p) {
    const dvec3 q = mirror(p);
    if (q.x < 0.20 && q.y > 1.20) {
        return skin_color(p - kHeadMiddle);
    }
    dvec3 color(0.62, 0.385, 0.285);
    const double hand_share =
        smoothstep(0.10, 0.19, glm::dot(q - at_joint(kLeftForearm), arm_direction()));
    return glm::mix(color, dvec3(0.61, 0.345, 0.255), 0.6 * hand_share);
}

dvec3 shirt_shade(dvec3 p) {
    const dvec3 q = mirror(p);
    // Seams: darker at neck, sleeves and hem.
    const double edge = std::min({neckline(p), kSleeve - along_arm(q), p.y - 0.908});
    return dvec3(mix(0.80, 1.0, smoothstep(0.006, 0.012, edge)) *
                 (1.0 + 0.04 * noise(p, 0.09, 81)));
}

dvec3 trousers_shade(dvec3 p) {
    const double knee =
        0.08 * smoothstep(0.12, 0.0, std::abs(p.y - 0.50)) * smoothstep(0.0, 0.05, p.z);
    return dvec3(0.92 + knee + 0.05 * noise(p, 0.11, 83));
}

dvec3 shoes_shade(dvec3 p) {
    return p.y < 0.0195 ? dvec3(1.0) : dvec3(0.42, 0.40, 0.40);
}

}  // namespace vellus::sculpt
