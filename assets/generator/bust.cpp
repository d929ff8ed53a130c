#include "assets/generator/bust.h"

#include <array>

#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// The bust is symmetric: everything is sculpted at x >= 0.
dvec3 mirror(dvec3 p) {
    return {std::abs(p.x), p.y, p.z};
}

double jaw(dvec3 q) {
    double d = ellipsoid(q, {0.0, -0.034, 0.0225}, {0.0555, 0.075, 0.0615});
    d = join(d, capsule(q, {0.0445, -0.055, -0.002}, {0.012, -0.0995, 0.061}, 0.0125, 0.0115),
             0.030);
    return join(d, ellipsoid(q, {0.0, -0.0985, 0.0655}, {0.0150, 0.0140, 0.0160}), 0.024);
}

double cheeks_and_brow(dvec3 q, double d) {
    d = join(d, ellipsoid(q, {0.0420, -0.0250, 0.0480}, {0.0190, 0.0170, 0.0200}), 0.032);
    d = join(d, ellipsoid(q, {0.0, -0.066, 0.0600}, {0.0300, 0.0270, 0.0275}), 0.030);
    return join(d, capsule(q, {0.0120, 0.0175, 0.0775}, {0.0450, 0.0165, 0.0575}, 0.0070, 0.0060),
                0.022);
}

double nose(dvec3 q, double d) {
    d = join(d, capsule(q, {0.0, 0.010, 0.0800}, {0.0, -0.0295, 0.1005}, 0.0040, 0.0052), 0.015);
    d = join(d, sphere(q, {0.0, -0.0345, 0.1010}, 0.0080), 0.007);
    d = join(d, ellipsoid(q, {0.0100, -0.0385, 0.0915}, {0.0050, 0.0054, 0.0080}), 0.006);
    return carve(d, ellipsoid(q, {0.0054, -0.0437, 0.0965}, {0.0026, 0.0030, 0.0044}), 0.003);
}

/// Where between mouth line and edge a point of the lips lies, seen from the front: 0 to 1, above
/// the mouth line for the upper lip and below it for the lower; outside elsewhere.
struct Lips {
    double upper, lower;
    /// Distance above the line where the lips meet.
    double above_line;
    /// 1 in the middle, 0 at the corner.
    double fullness;
};

Lips lips_at(dvec3 q) {
    const double x = q.x / 0.0245;
    const double line = -0.0682 + 0.0006 * x * x;
    const double side = saturate(1.0 - x * x);
    const double bow = 0.0074 * side * (1.0 - 0.18 * smoothstep(0.0035, 0.0, q.x)) + 1e-4;
    const double bowl = 0.0094 * side * (1.15 - 0.15 * side) + 1e-4;
    return {(q.y - line) / bow, (line - q.y) / bowl, q.y - line, smoothstep(1.0, 0.30, x)};
}

/// A rounded ridge over t in [0, 1], its top at `top`.
double ridge(double t, double top) {
    return t < 0.0 || t > 1.0 ? 0.0 : t < top ? smoothstep(0.0, top, t) : smoothstep(1.0, top, t);
}

double lips(dvec3 q, double d) {
    const Lips at = lips_at(q);
    d -= 0.0022 * ridge(at.upper, 0.40) * at.fullness;
    d -= 0.0030 * ridge(at.lower, 0.45) * at.fullness;
    const double groove = 1.0 - smoothstep(0.0, 0.0022, std::abs(at.above_line));
    d += 0.0013 * groove * smoothstep(0.0275, 0.0215, q.x);
    d = carve(d, ellipsoid(q, {0.0, -0.0525, 0.0985}, {0.0026, 0.0070, 0.0042}), 0.008);
    return carve(d, ellipsoid(q, {0.0, -0.0850, 0.0950}, {0.0150, 0.0040, 0.0055}), 0.010);
}

constexpr double kLidHalfWidth = 0.0140;
/// The outer corner stands a little higher.
constexpr double kLidSlant = 0.055;

/// Heights of the rims over and under the line between the corners; t as in upper_lid_rim.
double upper_rim(double t) {
    return 0.0054 * (1.0 - t * t) * (1.0 - 0.18 * t);
}
double lower_rim(double t) {
    return -0.0046 * (1.0 - t * t) * (1.0 + 0.15 * t);
}

/// Negative between the lids: an almond seen from the front.
double lid_opening(dvec3 q) {
    const double x = q.x - kEyeCenter.x;
    const double y = q.y - kEyeCenter.y - kLidSlant * x;
    const double t = x / kLidHalfWidth;
    return std::max(y - upper_rim(t), lower_rim(t) - y);
}

double eyes(dvec3 q, double d) {
    d = carve(d, ellipsoid(q, {0.0305, 0.0010, 0.0905}, {0.0190, 0.0112, 0.0150}), 0.016);
    const double lids = sphere(q, kEyeCenter, kEyeRadius + 0.0015);
    d = join(d, lids, 0.0045);
    // The fold above the upper lid.
    const double fold = 1.0 - smoothstep(0.0, 0.0022, std::abs(lid_opening(q) - 0.0046));
    d += 0.0008 * fold * smoothstep(-0.001, 0.003, q.y) * smoothstep(0.006, 0.003, lids);
    const double hole = std::max(lid_opening(q), kEyeCenter.z - q.z);
    return carve(d, std::max(hole, sphere(q, kEyeCenter, kEyeRadius + 0.012)), 0.0012);
}

double ear(dvec3 q) {
    const dvec3 center(0.0755, -0.0120, -0.0130);
    const dvec3 local = q - center;
    // The shell leans back and stands off at its rear edge.
    const dvec3 p(local.x + 0.35 * local.z + 0.10 * local.y, local.y + 0.20 * local.z,
                  local.z - 0.20 * local.y);
    double d = ellipsoid(p, dvec3(0.0), {0.0062, 0.0300, 0.0170});
    d = carve(d, ellipsoid(p, {0.0065, 0.0030, 0.0010}, {0.0052, 0.0190, 0.0100}), 0.004);
    return d * 0.85;
}

double torso(dvec3 q) {
    double d = capsule(q, {0.0, -0.070, -0.0230}, {0.0, -0.215, -0.0480}, 0.0435, 0.0470);
    d = join(d, capsule(q, {0.018, -0.130, -0.0600}, {0.115, -0.246, -0.0600}, 0.0240, 0.0300),
             0.045);
    d = join(d, ellipsoid(q, {0.0, -0.360, -0.0480}, {0.1400, 0.1550, 0.0900}), 0.050);
    d = join(d, capsule(q, {0.060, -0.262, -0.0500}, {0.145, -0.270, -0.0520}, 0.0440, 0.0440),
             0.040);
    d = join(d, capsule(q, {0.156, -0.285, -0.0520}, {0.174, -0.460, -0.0520}, 0.0450, 0.0370),
             0.030);
    d = join(d, capsule(q, {0.015, -0.226, 0.0020}, {0.122, -0.221, -0.0320}, 0.0058, 0.0056),
             0.016);
    d = join(d, capsule(q, {0.050, -0.045, -0.0250}, {0.010, -0.222, -0.0020}, 0.0100, 0.0070),
             0.026);
    d = join(d, ellipsoid(q, {0.064, -0.385, 0.0200}, {0.0620, 0.0640, 0.0480}), 0.045);
    return d;
}

}  // namespace

double skull_distance(dvec3 p) {
    const dvec3 q = mirror(p);
    double d = ellipsoid(q, {0.0, 0.031, -0.0140}, {0.0740, 0.0840, 0.0950});
    d = join(d, ellipsoid(q, {0.0, 0.038, 0.0250}, {0.0620, 0.0560, 0.0560}), 0.040);
    return join(d, jaw(q), 0.040);
}

double skin_distance(dvec3 p) {
    const dvec3 q = mirror(p);
    double d = skull_distance(q);
    if (q.y > -0.14 && q.z > 0.0) {
        d = cheeks_and_brow(q, d);
        d = nose(q, d);
        d = lips(q, d);
        d = eyes(q, d);
    }
    d = join(d, ear(q), 0.008);
    d = join(d, torso(q), 0.022);
    return meet(d, -0.40 - p.y, 0.004);
}

dvec3 upper_lid_rim(double t) {
    return kEyeCenter + dvec3(t * kLidHalfWidth, upper_rim(t) + kLidSlant * t * kLidHalfWidth, 0.0);
}

double cloth_distance(dvec3 p) {
    const dvec3 q = mirror(p);
    const double layer = torso(q) - 0.0045;
    const double neckline = 0.012 - ellipsoid(p, {0.0, -0.195, 0.0050}, {0.1120, 0.0850, 0.1500});
    return meet(meet(layer, neckline, 0.008), -0.402 - p.y, 0.004);
}

double bust_distance(dvec3 p) {
    const double skin = skin_distance(p);
    return p.y < -0.15 ? std::min(skin, cloth_distance(p)) : skin;
}

double above_hairline(dvec3 p) {
    // Height of the hairline from the nape over the ear and temple to the forehead, by depth.
    struct Knot {
        double z, y;
    };
    constexpr std::array kLine = {Knot{-0.110, -0.082}, Knot{-0.075, -0.076}, Knot{-0.048, -0.050},
                                  Knot{-0.034, -0.010}, Knot{-0.014, 0.018},  Knot{0.004, 0.010},
                                  Knot{0.013, -0.006},  Knot{0.024, 0.004},   Knot{0.032, 0.034},
                                  Knot{0.044, 0.057},   Knot{0.062, 0.071},   Knot{0.090, 0.074}};
    size_t i = 1;
    while (i + 1 < kLine.size() && p.z > kLine[i].z) {
        ++i;
    }
    const Knot a = kLine[i - 1];
    const Knot b = kLine[i];
    return p.y - mix(a.y, b.y, saturate((p.z - a.z) / (b.z - a.z)));
}

dvec3 skin_color(dvec3 p) {
    const dvec3 q = mirror(p);
    dvec3 color(0.62, 0.385, 0.285);
    const dvec3 blush(0.60, 0.285, 0.215);
    const auto tint = [&](dvec3 target, double amount) { color += (target - color) * amount; };
    tint(blush, 0.55 * smoothstep(0.022, 0.002,
                                  ellipsoid(q, {0.043, -0.030, 0.060}, {0.010, 0.008, 0.01})));
    tint(blush, 0.45 * smoothstep(0.012, 0.000, sphere(q, {0.0, -0.037, 0.105}, 0.006)));
    tint(blush, 0.50 * smoothstep(0.004, -0.002, ear(q)));
    // Lids are a little darker, and darkest at their rim.
    tint({0.46, 0.235, 0.175}, 0.55 * smoothstep(0.0075, 0.0015, std::abs(lid_opening(q))) *
                                   smoothstep(0.006, 0.002, sphere(q, kEyeCenter, kEyeRadius)));
    tint({0.16, 0.070, 0.050}, 0.85 * smoothstep(0.0014, 0.0, lid_opening(q)) *
                                   smoothstep(0.004, 0.002, sphere(q, kEyeCenter, kEyeRadius)));
    if (q.z > 0.06) {
        const Lips at = lips_at(q);
        const double inside =
            1.0 - std::max(smoothstep(0.85, 1.05, at.upper), smoothstep(0.88, 1.05, at.lower));
        const double width = smoothstep(0.0262, 0.0225, q.x);
        tint({0.43, 0.135, 0.120}, 0.85 * inside * width);
        tint({0.14, 0.035, 0.034},
             0.75 * smoothstep(0.0014, 0.0001, std::abs(at.above_line)) * width);
    }
    tint({0.20, 0.075, 0.055},
         smoothstep(0.0015, -0.0005,
                    ellipsoid(q, {0.0054, -0.0437, 0.0965}, {0.0026, 0.0030, 0.0044})));
    if (skull_distance(q) < 0.006 && q.y > -0.1) {
        tint({0.085, 0.045, 0.028}, 0.9 * smoothstep(-0.003, 0.014, above_hairline(p)));
    }
    return color;
}

dvec3 joint_weights(dvec3 p) {
    const double along = p.y + 0.5 * (p.z + 0.02);
    const double head = smoothstep(-0.155, -0.088, along);
    const double neck = smoothstep(-0.270, -0.165, along) * (1.0 - head);
    return {1.0 - head - neck, neck, head};
}

}  // namespace vellus::sculpt
