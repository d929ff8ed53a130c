// environment=sh_depth: light of the surroundings that finds its way through the hair. Each point of a
// groom knows how much hair lies around it, as optical depths along the six axes of its groom as far as the
// skin, worked out when it is loaded (modules/hair/environment/ambient_depth.h). The sky's light loses
// 1 - a_f of itself by optical depth on its way here; what fibres turn back has lost its way and lies as a
// level over the hair around: that level is what escapes from here at each turning (the escape probability
// of V. V. Sobolev, "A Treatise on Radiative Transfer", 1949). Hair that keeps nothing is as bright as an
// even sky, however much there is of it. Between axes the six values are blended by squared cosines, which
// add up to one (the ambient cube of J. McTaggart, "Half-Life 2 / Valve Source Shading", GDC 2004).
//
// A fibre takes in light from the cone that mirrors the eye's inclination: the half in front of it counts
// with a_b, the half behind with a_f (dual.glsl).
#ifndef VELLUS_HAIR_AMBIENT_GLSL
#define VELLUS_HAIR_AMBIENT_GLSL
#include "hair/scattering/dual.glsl"
#include "light/sh.glsl"

const float kAmbientScale = 4.0f;
const float kAmbientMost = 60.0f;  // optical depth beyond which nothing more is told apart
const float kAmbientSkin = 0.2f;   // share of the level that skin sends back

/// By axis: x, y, z of the groom, and against them.
struct AmbientDepths {
    vec3 along;
    vec3 against;
    vec3 open_along;  // share of the sky there that no skin hides
    vec3 open_against;
};

/// Light, or a share of it, by axis.
struct AmbientLight {
    vec3 along[3];
    vec3 against[3];
};

/// Ten bits: optical depth as one of 63 steps, fine where there is little hair, and openness as one of 16.
VELLUS_FN uint ambient_code(float depth, float open) {
    float d = max(depth, 0.0f);
    return uint(62.0f * (d / (d + kAmbientScale)) + 0.5f) | (uint(15.0f * open + 0.5f) << 6);
}

/// Of a word with three codes.
VELLUS_FN vec3 ambient_steps(uint word) {
    return vec3(float(word & 63u), float((word >> 10) & 63u), float((word >> 20) & 63u));
}

VELLUS_FN vec3 ambient_open(uint word) {
    return vec3(float((word >> 6) & 15u), float((word >> 16) & 15u), float((word >> 26) & 15u)) * (1.0f / 15.0f);
}

/// Optical depths of steps, blended or not.
VELLUS_FN vec3 ambient_depth(vec3 steps) {
    vec3 share = steps * (1.0f / 62.0f);
    return min(kAmbientScale * share / max(vec3(1.0f) - share, vec3(1.0e-3f)), vec3(kAmbientMost));
}

/// What is blended of six values for direction `d` (unit, or shorter where it fades).
VELLUS_FN vec3 ambient_blend(vec3 d, VELLUS_IN(AmbientLight) light) {
    vec3 w = d * d;
    return w.x * (d.x > 0.0f ? light.along[0] : light.against[0]) +
           w.y * (d.y > 0.0f ? light.along[1] : light.against[1]) +
           w.z * (d.z > 0.0f ? light.along[2] : light.against[2]);
}

/// The sky as a lobe of 0.35 radians (e^(-l(l+1) 0.35²/2) of band l) sees it around `d`, from its
/// irradiance/π, of which bands 1 and 2 have 2/3 and 1/4; >= 0.
VELLUS_FN vec3 ambient_sky(VELLUS_IN(Sh9) sh, vec3 d) {
    vec3 one = sh.c[1] * d.x + sh.c[2] * d.y + sh.c[3] * d.z;
    vec3 two = sh.c[4] * (d.x * d.y) + sh.c[5] * (d.y * d.z) + sh.c[7] * (d.x * d.z) +
               sh.c[6] * (2.0f * d.y * d.y - d.x * d.x - d.z * d.z) + sh.c[8] * (d.z * d.z - d.x * d.x);
    return max(sh.c[0] + 1.327f * one + 2.770f * two, vec3(0.0f));
}

/// What arrives at a point: the share of the sky that gets there by axis, and the light around instead.
struct AmbientArrival {
    AmbientLight sky;
    AmbientLight around;
};

/// From one axis: the share of the sky, and how much of the level around (hair that turns `turned` of what
/// it takes from a beam, skin).
struct AmbientWay {
    vec3 sky;
    vec3 around;
};

VELLUS_FN AmbientWay ambient_way(vec3 falloff, vec3 turned, float depth, float open) {
    vec3 through = exp2(falloff * depth);
    AmbientWay way;
    way.sky = through * open;
    way.around = turned + through * (vec3(kAmbientSkin * (1.0f - open)) - turned);
    return way;
}

/// Where beams lose `lost` = 1 - a_f and fibres turn back a_b = `back`; `light` is irradiance/π that faces
/// each axis.
VELLUS_FN AmbientArrival ambient_arrival(vec3 lost, vec3 back, VELLUS_IN(AmbientLight) light,
                                         AmbientDepths depths) {
    vec3 falloff = -kLog2E * lost;
    vec3 turned = back / lost;
    AmbientArrival arrival;
    vec3 sky = vec3(0.0f);
    vec3 around = vec3(0.0f);
    for (int i = 0; i < 3; ++i) {
        AmbientWay along = ambient_way(falloff, turned, depths.along[i], depths.open_along[i]);
        AmbientWay against = ambient_way(falloff, turned, depths.against[i], depths.open_against[i]);
        arrival.sky.along[i] = along.sky;
        arrival.sky.against[i] = against.sky;
        arrival.around.along[i] = along.around;
        arrival.around.against[i] = against.around;
        sky += along.sky * light.along[i] + against.sky * light.against[i];
        around += along.around + against.around;
    }
    // Hair that loses nothing, all around: no sky, and no level.
    vec3 level = sky / max(vec3(6.0f) - around, vec3(1.0e-6f));
    for (int i = 0; i < 3; ++i) {
        arrival.around.along[i] *= level;
        arrival.around.against[i] *= level;
    }
    return arrival;
}

/// Radiance from direction `d` of the world.
VELLUS_FN vec3 ambient_from(vec3 d, mat3 axes, VELLUS_IN(Sh9) sky, VELLUS_IN(AmbientArrival) arrival) {
    vec3 local = d * axes;
    return ambient_sky(sky, d) * ambient_blend(local, arrival.sky) + ambient_blend(local, arrival.around);
}

/// Radiance to the eye. `depths` are in fibres as wide as they are drawn, along the groom's `axes`, and
/// `light` what faces those.
VELLUS_FN vec3 hair_ambient(VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, vec3 tangent, mat3 axes,
                            VELLUS_IN(Sh9) sky, VELLUS_IN(AmbientLight) light, AmbientDepths depths) {
    float cos2_t = 1.0f - f.sin_r * f.sin_r * fibre.inverse_index2;
    vec3 half_log = hair_log2_color(s.base_color) * (0.5f * inversesqrt(cos2_t));
    HairAverages m = hair_averages(fibre, s, half_log, f.cos_r);
    float multiple = min(s.scatter, 1.0f);
    AmbientArrival arrival =
        ambient_arrival(vec3(1.0f) - m.forward * multiple, m.backward * multiple, light, depths);
    // Two directions on either half of the cone: ±45° from its front, where R and TRT spread out, and ±30°
    // from its back, around which TT is narrow.
    vec3 mirrored = -f.sin_r * tangent;
    vec3 side = cross(tangent, f.normal) * f.cos_r;
    vec3 ahead = f.normal * f.cos_r;
    vec3 near_front = mirrored + 0.707106781f * ahead;
    vec3 near_back = mirrored - 0.866025404f * ahead;
    vec3 front = ambient_from(near_front + 0.707106781f * side, axes, sky, arrival) +
                 ambient_from(near_front - 0.707106781f * side, axes, sky, arrival);
    vec3 behind = ambient_from(near_back + 0.5f * side, axes, sky, arrival) +
                  ambient_from(near_back - 0.5f * side, axes, sky, arrival);
    return 0.5f * (m.backward * front + m.forward * behind);
}

#endif
