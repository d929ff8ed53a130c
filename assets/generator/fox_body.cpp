#include "assets/generator/eyeball.h"
#include "assets/generator/fox.h"
#include "assets/generator/random.h"
#include "assets/generator/sdf.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

dvec3 mirror(dvec3 p) {
    return {std::abs(p.x), p.y, p.z};
}

constexpr dvec3 kFoxEye{0.0385, 0.5440, 0.3640};
constexpr double kFoxEyeRadius = 0.0140;
/// Ahead, outwards and a little up; a unit vector.
constexpr dvec3 kFoxLook{0.3849, 0.1100, 0.9164};

double trunk(dvec3 q) {
    double d = capsule(q, {0.0, 0.350, 0.125}, {0.0, 0.368, -0.040}, 0.0920, 0.0780);
    d = join(d, capsule(q, {0.0, 0.368, -0.040}, {0.0, 0.358, -0.185}, 0.0780, 0.0820), 0.040);
    d = join(d, ellipsoid(q, {0.0, 0.345, 0.165}, {0.0740, 0.0940, 0.0800}), 0.050);
    return join(d, capsule(q, {0.0, 0.400, 0.165}, {0.0, 0.500, 0.265}, 0.0680, 0.0560), 0.050);
}

double fox_head(dvec3 q) {
    double d = ellipsoid(q, {0.0, 0.540, 0.305}, {0.0700, 0.0600, 0.0680});
    d = join(d, ellipsoid(q, {0.046, 0.512, 0.308}, {0.0420, 0.0330, 0.0400}), 0.030);
    d = join(d, capsule(q, {0.0, 0.517, 0.355}, {0.0, 0.502, 0.432}, 0.0330, 0.0165), 0.030);
    d = join(d, capsule(q, {0.0, 0.500, 0.350}, {0.0, 0.487, 0.415}, 0.0220, 0.0120), 0.016);
    // Sockets.
    d = carve(d, ellipsoid(q, {0.040, 0.546, 0.376}, {0.0140, 0.0110, 0.0120}), 0.012);
    d = join(d, sphere(q, kFoxEye, kFoxEyeRadius + 0.0012), 0.006);
    // The lids open around where the eye looks.
    const double opening = std::max(0.0078 - glm::dot(q - kFoxEye, kFoxLook),
                                    sphere(q, kFoxEye, kFoxEyeRadius + 0.010));
    return carve(d, opening, 0.0015);
}

double fox_ear(dvec3 q) {
    const dvec3 base(0.0440, 0.585, 0.285);
    const dvec3 tip(0.0660, 0.672, 0.278);
    // Flat from front to back, hollow in front.
    const dvec3 flat(q.x, q.y, base.z + (q.z - base.z) * 1.9);
    const double shell = capsule(flat, base, tip, 0.0330, 0.0060) * 0.6;
    const double hollow =
        capsule({q.x, q.y, base.z + (q.z - base.z) * 1.2}, base + dvec3(0.003, 0.004, 0.021),
                tip + dvec3(-0.001, -0.014, 0.009), 0.0200, 0.0030) *
        0.8;
    return carve(shell, hollow, 0.006);
}

double fox_legs(dvec3 q) {
    double d = capsule(q, {0.060, 0.335, 0.125}, {0.066, 0.200, 0.118}, 0.0470, 0.0260);
    d = join(d, capsule(q, {0.066, 0.200, 0.118}, {0.066, 0.045, 0.132}, 0.0255, 0.0190), 0.016);
    d = join(d, ellipsoid(q, {0.066, 0.022, 0.148}, {0.0270, 0.0225, 0.0380}), 0.014);
    double hind = capsule(q, {0.055, 0.320, -0.170}, {0.068, 0.215, -0.140}, 0.0660, 0.0400);
    hind = join(hind, capsule(q, {0.068, 0.215, -0.140}, {0.070, 0.125, -0.222}, 0.0370, 0.0205),
                0.020);
    hind = join(hind, capsule(q, {0.070, 0.125, -0.222}, {0.070, 0.035, -0.205}, 0.0200, 0.0180),
                0.014);
    hind = join(hind, ellipsoid(q, {0.070, 0.021, -0.186}, {0.0260, 0.0215, 0.0390}), 0.014);
    return std::min(d, hind);
}

double fox_tail(dvec3 q) {
    double d = capsule(q, {0.0, 0.375, -0.240}, {0.0, 0.335, -0.350}, 0.0280, 0.0440);
    d = join(d, capsule(q, {0.0, 0.335, -0.350}, {0.0, 0.285, -0.470}, 0.0450, 0.0580), 0.020);
    return join(d, capsule(q, {0.0, 0.285, -0.470}, {0.0, 0.275, -0.590}, 0.0560, 0.0140), 0.020);
}

/// Linear from sRGB by a cubic, within a hundredth.
dvec3 linear(dvec3 c) {
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

dvec3 skin_shade(dvec3 p) {
    const dvec3 q = mirror(p);
    // Lids.
    const double eye = sphere(q, kFoxEye, kFoxEyeRadius);
    const dvec3 color = linear(fox_srgb(p)) * 0.75;
    return glm::mix(dvec3(0.012, 0.009, 0.008), color, smoothstep(0.0014, 0.0028, eye));
}

/// A fox's eye, brighter and with a smaller white than a person's.
dvec3 fox_eye_color(double from_axis, bool front) {
    if (!front) {
        return dvec3(0.02);
    }
    const dvec3 iris = glm::mix(dvec3(0.62, 0.30, 0.05), dvec3(0.26, 0.10, 0.015),
                                smoothstep(0.0040, 0.0088, from_axis));
    const dvec3 color = glm::mix(dvec3(0.004), iris, smoothstep(0.0042, 0.0050, from_axis));
    return glm::mix(color, dvec3(0.012, 0.008, 0.006), smoothstep(0.0086, 0.0096, from_axis));
}

SkinnedPart fox_eyes() {
    constexpr double kRings[] = {0.0020, 0.0041, 0.0051, 0.0070, 0.0085, 0.0097, 0.0120, 0.0136};
    SkinnedPart part{"eyes", {}, {}, {}, dvec3(1.0), 0.06};
    for (const double side : {1.0, -1.0}) {
        const dvec3 center = kFoxEye * dvec3(side, 1.0, 1.0);
        const Eyeball eye = make_eyeball(dvec3(0.0), kFoxEyeRadius, 16, kRings);
        const dvec3 ahead = glm::normalize(kFoxLook * dvec3(side, 1.0, 1.0));
        const dvec3 across = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), ahead));
        const glm::dmat3 turn(across, glm::cross(ahead, across), ahead);
        const auto first = static_cast<uint32_t>(part.surface.positions.size());
        for (const dvec3 p : eye.surface.positions) {
            part.surface.positions.push_back(center + turn * p);
            part.surface.normals.push_back(turn * glm::normalize(p));
            part.colors.push_back(fox_eye_color(std::sqrt(p.x * p.x + p.y * p.y), p.z > 0.0));
            part.influences.push_back({{kFoxHead, 0, 0, 0}, {1.0, 0.0, 0.0, 0.0}});
        }
        for (const uint32_t index : eye.surface.indices) {
            part.surface.indices.push_back(first + index);
        }
    }
    return part;
}

}  // namespace

double fox_skin(dvec3 p) {
    const dvec3 q = mirror(p);
    double d = join(trunk(q), fox_legs(q), 0.030);
    d = join(d, fox_tail(q), 0.030);
    if (q.y > 0.42 && q.z > 0.15) {
        d = join(d, join(fox_head(q), fox_ear(q), 0.012), 0.030);
    }
    return d;
}

dvec3 fox_srgb(dvec3 p) {
    const dvec3 q = mirror(p);
    const double mottle = 0.5 + 0.5 * noise(p, 0.055, 111);
    const dvec3 red = glm::mix(dvec3(0.80, 0.43, 0.16), dvec3(0.70, 0.34, 0.11), mottle);
    const dvec3 cream(0.93, 0.87, 0.78);
    const dvec3 dark(0.16, 0.11, 0.09);
    dvec3 color = red;
    const auto paint = [&](dvec3 with, double share) { color = glm::mix(color, with, share); };
    // Back darker, belly and chest pale.
    paint({0.58, 0.27, 0.09}, 0.6 * smoothstep(0.42, 0.47, q.y) * smoothstep(0.20, 0.10, q.z) *
                                  smoothstep(0.045, 0.010, q.x));
    paint(cream, smoothstep(0.300, 0.265, q.y) * smoothstep(0.060, 0.035, q.x) *
                     smoothstep(0.24, 0.27, q.y));
    paint(cream, smoothstep(0.075, 0.045, q.x) *
                     smoothstep(0.185, 0.235, q.z + 0.25 * (0.42 - q.y)) *
                     smoothstep(0.500, 0.470, q.y));
    // Cheeks, muzzle and brows.
    paint(cream, smoothstep(0.512, 0.497, q.y - 0.25 * std::max(0.0, q.x - 0.045)) *
                     smoothstep(0.250, 0.290, q.z));
    paint(cream, 0.9 * smoothstep(0.016, 0.030, q.x) * smoothstep(0.350, 0.372, q.z) *
                     smoothstep(0.528, 0.514, q.y));
    // Stockings and backs of the ears.
    paint(dark, smoothstep(0.165, 0.105, q.y));
    paint(dark, smoothstep(0.628, 0.650, q.y));
    paint(dark, smoothstep(0.590, 0.620, q.y) * smoothstep(0.284, 0.272, q.z));
    paint(cream, smoothstep(0.590, 0.605, q.y) * smoothstep(0.650, 0.630, q.y) *
                     smoothstep(0.287, 0.297, q.z));
    // Tip of the tail.
    paint(dark, 0.45 * smoothstep(-0.40, -0.47, q.z));
    paint(cream, smoothstep(-0.500, -0.535, q.z + 0.01 * noise(p, 0.02, 112)));
    return color;
}

std::vector<SkinnedPart> make_fox() {
    std::vector<SkinnedPart> parts;
    constexpr double kFine = 0.0042;
    constexpr double kCoarse = 0.0075;
    parts.push_back(
        sculpt_part({"skin",
                     {grid_lines(-0.140, {{-0.085, kCoarse}, {0.085, kFine}, {0.140, kCoarse}}),
                      grid_lines(-0.020, {{0.060, kFine}, {0.440, kCoarse}, {0.700, kFine}}),
                      grid_lines(-0.640, {{0.210, kCoarse}, {0.470, kFine}})},
                     fox_skin,
                     skin_shade,
                     fox_influences,
                     7'000,
                     dvec3(1.0),
                     0.85}));
    const auto nose = [](dvec3 p) {
        return join(ellipsoid(p, {0.0, 0.5075, 0.4440}, {0.0135, 0.0105, 0.0100}),
                    ellipsoid(p, {0.0, 0.4990, 0.4440}, {0.0060, 0.0080, 0.0070}), 0.006);
    };
    parts.push_back(
        sculpt_part({"nose",
                     {grid_lines(-0.020, {{0.020, 0.0020}}), grid_lines(0.485, {{0.525, 0.0020}}),
                      grid_lines(0.425, {{0.465, 0.0020}})},
                     nose,
                     [](dvec3) { return dvec3(0.012, 0.010, 0.010); },
                     fox_influences,
                     300,
                     dvec3(1.0),
                     0.25}));
    parts.push_back(fox_eyes());
    return parts;
}

}  // namespace vellus::sculpt
