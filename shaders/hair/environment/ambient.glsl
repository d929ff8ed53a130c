// environment=sh_depth: light of the surroundings that finds its way through the hair. Each point of a
// groom knows how much hair lies around it, as optical depths along the six axes of its groom, worked out
// when it is loaded (modules/hair/environment/ambient_depth.h). From each axis comes the environment's
// irradiance/π, less what the hair keeps: e^(-n (1 - a_f)), what passes n fibres untouched or scattered
// forward only (dual.glsl). Between axes the six values are blended by squared cosines, which add up to
// one (the ambient cube of J. McTaggart, "Half-Life 2 / Valve Source Shading", GDC 2004).
//
// A fibre takes in light from the cone that mirrors the eye's inclination: the half in front of it counts
// with a_b, the half behind with a_f; the hair behind it turns A_b = R∞ - a_b of what comes from the front.
// White hair under an even sky then is as bright as the sky, however deep.
#ifndef VELLUS_HAIR_AMBIENT_GLSL
#define VELLUS_HAIR_AMBIENT_GLSL
#include "hair/scattering/dual.glsl"

const float kAmbientScale = 4.0f;
const float kAmbientMost = 60.0f;  // optical depth beyond which nothing more is told apart

/// By axis: x, y, z of the groom, and against them.
struct AmbientDepths {
    vec3 along;
    vec3 against;
};

/// Irradiance/π that faces each axis.
struct AmbientLight {
    vec3 along[3];
    vec3 against[3];
};

/// Optical depth as one of 255 steps, fine where there is little hair; its inverse.
VELLUS_FN uint ambient_code(float depth) {
    float d = max(depth, 0.0f);
    return uint(254.0f * (d / (d + kAmbientScale)) + 0.5f);
}

VELLUS_FN vec3 ambient_depth(vec3 code) {
    vec3 share = code * (1.0f / 254.0f);
    return min(kAmbientScale * share / max(vec3(1.0f) - share, vec3(1.0e-3f)), vec3(kAmbientMost));
}

/// What is blended of six values for direction `d` (unit, or shorter where it fades).
VELLUS_FN vec3 ambient_blend(vec3 d, VELLUS_IN(AmbientLight) light) {
    vec3 w = d * d;
    return w.x * (d.x > 0.0f ? light.along[0] : light.against[0]) +
           w.y * (d.y > 0.0f ? light.along[1] : light.against[1]) +
           w.z * (d.z > 0.0f ? light.along[2] : light.against[2]);
}

/// Radiance to the eye. `depths` are in fibres as wide as they are drawn; `tangent` and `normal` are the
/// frame's in the groom's axes.
VELLUS_FN vec3 hair_ambient(VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, vec3 tangent, vec3 normal,
                            VELLUS_IN(AmbientLight) light, AmbientDepths depths) {
    float cos2_t = 1.0f - f.sin_r * f.sin_r * fibre.inverse_index2;
    vec3 half_log = hair_log2_color(s.base_color) * (0.5f * inversesqrt(cos2_t));
    HairAverages m = hair_averages(fibre, s, half_log, f.cos_r);
    float multiple = min(s.scatter, 1.0f);
    vec3 lost = -kLog2E * (vec3(1.0f) - m.forward * multiple);

    AmbientLight through;
    AmbientLight arriving;
    for (int i = 0; i < 3; ++i) {
        through.along[i] = exp2(lost * depths.along[i]);
        through.against[i] = exp2(lost * depths.against[i]);
        arriving.along[i] = light.along[i] * through.along[i];
        arriving.against[i] = light.against[i] * through.against[i];
    }
    // Two directions on either half of the cone, at ±45° and ±135° around the fibre.
    vec3 side = cross(tangent, normal) * (0.707106781f * f.cos_r);
    vec3 ahead = normal * (0.707106781f * f.cos_r);
    vec3 mirrored = -f.sin_r * tangent;
    vec3 front = ambient_blend(mirrored + ahead + side, arriving) +
                 ambient_blend(mirrored + ahead - side, arriving);
    vec3 left = mirrored - ahead + side;
    vec3 right = mirrored - ahead - side;
    vec3 behind = ambient_blend(left, arriving) + ambient_blend(right, arriving);
    // Only what the hair behind stops can it turn back.
    vec3 stopped = vec3(1.0f) - 0.5f * (ambient_blend(left, through) + ambient_blend(right, through));
    vec3 back = dual_backscatter(m.forward, m.backward) * stopped * multiple;
    return 0.5f * (m.backward * front + m.forward * behind) + back * ambient_blend(normal, arriving);
}

#endif
