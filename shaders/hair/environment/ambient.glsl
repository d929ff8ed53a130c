// environment=sh_depth: light of the surroundings that finds its way through the hair. Each point of a
// groom knows how much hair lies around it, as optical depths along the six axes of its groom, worked out
// when it is loaded (modules/hair/environment/ambient_depth.h). Along each axis light goes both ways, and
// every fibre passes a_f of it on and turns a_b of it back (dual.glsl), which leaves the two streams of
// P. Kubelka and F. Munk (1931). At their ends stands the environment's irradiance/π. Between axes the six
// values are blended by squared cosines, which add up to one (the ambient cube of J. McTaggart, "Half-Life
// 2 / Valve Source Shading", GDC 2004).
//
// A fibre takes in light from the cone that mirrors the eye's inclination: the half in front of it counts
// with a_b, the half behind with a_f. Streams meet in the nearest hair alone: what lies deeper is mostly
// skin, from which little comes back. Light from there fades as in deep hair.
#ifndef VELLUS_HAIR_AMBIENT_GLSL
#define VELLUS_HAIR_AMBIENT_GLSL
#include "hair/scattering/dual.glsl"

const float kAmbientScale = 4.0f;
const float kAmbientBacked = 1.0f;  // optical depth of hair that turns light back: behind it is skin
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

/// What arrives along one axis, from ahead and from behind, at a point with that much hair (optical depth)
/// on either side of it.
struct AmbientStreams {
    vec3 ahead;
    vec3 behind;
};

/// Two streams that lose `lost` = 1 - a_f of themselves by optical depth and gain `back` = a_b of each other;
/// `k` = √(lost² - back²). Exact for a slab that nothing leaves sideways, kAmbientBacked to either side.
VELLUS_FN AmbientStreams ambient_streams(vec3 lost, vec3 back, vec3 k, float depth_ahead, float depth_behind,
                                         vec3 light_ahead, vec3 light_behind) {
    vec3 falloff = -kLog2E * k;
    light_ahead *= exp2(falloff * max(depth_ahead - kAmbientBacked, 0.0f));
    light_behind *= exp2(falloff * max(depth_behind - kAmbientBacked, 0.0f));
    vec3 a = exp2(falloff * min(depth_ahead, kAmbientBacked));
    vec3 b = exp2(falloff * min(depth_behind, kAmbientBacked));
    vec3 a2 = a * a;
    vec3 b2 = b * b;
    vec3 one = vec3(1.0f);
    vec3 share = one / (k * (one + a2 * b2) + lost * (one - a2 * b2));
    vec3 in_ahead = light_ahead * a * share;
    vec3 in_behind = light_behind * b * share;
    AmbientStreams s;
    s.ahead = in_ahead * (k * (one + b2) + lost * (one - b2)) + in_behind * back * (one - a2);
    s.behind = in_behind * (k * (one + a2) + lost * (one - a2)) + in_ahead * back * (one - b2);
    return s;
}

/// Radiance to the eye. `depths` are in fibres as wide as they are drawn; `tangent` and `normal` are the
/// frame's in the groom's axes.
VELLUS_FN vec3 hair_ambient(VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, vec3 tangent, vec3 normal,
                            VELLUS_IN(AmbientLight) light, AmbientDepths depths) {
    float cos2_t = 1.0f - f.sin_r * f.sin_r * fibre.inverse_index2;
    vec3 half_log = hair_log2_color(s.base_color) * (0.5f * inversesqrt(cos2_t));
    HairAverages m = hair_averages(fibre, s, half_log, f.cos_r);
    float multiple = min(s.scatter, 1.0f);
    vec3 lost = vec3(1.0f) - m.forward * multiple;
    vec3 turned = m.backward * multiple;
    // Hair that loses nothing still has a falloff: the streams' quotient stays one of floats.
    vec3 k = sqrt(max((lost - turned) * (lost + turned), vec3(1.0e-6f)));

    AmbientLight arriving;
    for (int i = 0; i < 3; ++i) {
        AmbientStreams streams = ambient_streams(lost, turned, k, depths.along[i], depths.against[i],
                                                 light.along[i], light.against[i]);
        arriving.along[i] = streams.ahead;
        arriving.against[i] = streams.behind;
    }
    // Two directions on either half of the cone, at ±45° and ±135° around the fibre.
    vec3 side = cross(tangent, normal) * (0.707106781f * f.cos_r);
    vec3 ahead = normal * (0.707106781f * f.cos_r);
    vec3 mirrored = -f.sin_r * tangent;
    vec3 front = ambient_blend(mirrored + ahead + side, arriving) +
                 ambient_blend(mirrored + ahead - side, arriving);
    vec3 behind = ambient_blend(mirrored - ahead + side, arriving) +
                  ambient_blend(mirrored - ahead - side, arriving);
    return 0.5f * (m.backward * front + m.forward * behind);
}

#endif
