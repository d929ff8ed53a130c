// Multiple scattering of a punctual light by dual scattering, after Zinke, Yuksel, Weber, Keyser 2008: light
// that other fibres pass on (global, forward) and light that the surrounding fibres turn back (local).
//
// n, the mean number of fibres between here and the light, is -ln of the hair's shadow: the shadow's falloff
// is their number per metre. Around that mean they are Poisson distributed, so that of the light
// e^(-n) arrives untouched and e^(-n (1 - a_f)) - e^(-n) after forward scattering alone, where Zinke's
// a_f^n counts whole fibres and takes a density factor; what turns back and on again is added. Local
// backscatter has all orders, A_b = R∞ - a_b (modules/hair/reference/dual_scattering.h), instead of one
// and three. Both end where the hair does: a deep opacity map knows how many fibres are behind.
#ifndef VELLUS_HAIR_DUAL_GLSL
#define VELLUS_HAIR_DUAL_GLSL
#include "hair/scattering/azimuthal.glsl"

const float kDualMostFibres = 60.0f;
const float kDualMostTilt = 0.3f;  // radians

/// What a fibre does on average to light of one inclination (Zinke, eq. 6 and 11-14); colours by channel.
struct HairAverages {
    vec3 forward;    // a_f
    vec3 backward;   // a_b; a_f + a_b < 1
    float forward_variance;
    float backward_variance;
    float forward_tilt;
    float backward_tilt;
};

/// At an inclination of cosine `cos_i`, where a narrow lobe sees θd = θi.
VELLUS_FN HairAverages hair_averages(VELLUS_IN(HairFibre) fibre, HairSurface s, vec3 half_log,
                                     float cos_i) {
    float u = cos_i / (cos_i + kGrazing);
    float u2 = u * u;
    vec3 q = vec3(1.0f, u, u2);
    vec4 cubic = vec4(1.0f, u, u2, u2 * u);
    vec3 path_short = exp2(half_log * kPathShort);
    vec3 path_long = exp2(half_log * kPathLong);
    vec3 path_trt = path_short * path_long;
    // Of a fibre that absorbs nothing: R, then both paths of TT, and TRT.
    float r_forward = dot(fibre.r_forward, cubic);
    float r_backward = dot(fibre.r_backward, cubic);
    vec3 forward = u2 * vec3(dot(fibre.forward[0], q), dot(fibre.forward[1], q), dot(fibre.forward[2], q));
    vec3 backward = u2 * vec3(dot(fibre.backward[0], q), dot(fibre.backward[1], q), dot(fibre.backward[2], q));
    // What has turned inside three times and more is what all these leave.
    float rest = 1.0f - r_forward - r_backward - dot(forward + backward, vec3(1.0f));
    vec3 residual = path_trt * path_long * (0.5f * clamp(rest, 0.0f, 0.2f));

    float reflected = 2.0f * s.specular;
    r_forward = reflected * max(r_forward, 0.0f);
    r_backward = reflected * max(r_backward, 0.0f);
    vec3 tt_forward = max(path_short * forward.x + path_long * forward.y, vec3(0.0f));
    vec3 tt_backward = max(path_short * backward.x + path_long * backward.y, vec3(0.0f));
    vec3 trt_forward = path_trt * max(forward.z, 0.0f);
    vec3 trt_backward = path_trt * max(backward.z, 0.0f);
    HairAverages a;
    a.forward = clamp(vec3(r_forward) + tt_forward + trt_forward + residual, vec3(1.0e-4f), vec3(0.995f));
    a.backward = clamp(vec3(r_backward) + tt_backward + trt_backward + residual, vec3(1.0e-4f),
                       vec3(0.9999f) - a.forward);
    // Spreads hardly depend on the channel: one for all, weighted by energy.
    vec3 third = vec3(1.0f / 3.0f);
    vec3 v = vec3(1.0f) / fibre.inverse_v;
    vec3 f = vec3(r_forward, dot(tt_forward, third), dot(trt_forward, third));
    vec3 b = vec3(r_backward, dot(tt_backward, third), dot(trt_backward, third));
    f /= max(f.x + f.y + f.z, 1.0e-8f);
    b /= max(b.x + b.y + b.z, 1.0e-8f);
    a.forward_variance = max(dot(f, v), 1.0e-6f);
    a.backward_variance = max(dot(b, v), 1.0e-6f);
    a.forward_tilt = dot(f, fibre.sin_tilt);
    a.backward_tilt = dot(b, fibre.sin_tilt);
    return a;
}

/// How fast light of all orders fades by the fibre, Schuster's two streams F' = -(1 - f) F + b B and
/// -B' = -(1 - f) B + b F: as e^(-k n).
VELLUS_FN vec3 dual_fading(vec3 f, vec3 b) {
    vec3 lost = vec3(1.0f) - f;
    return sqrt(max((lost - b) * (lost + b), vec3(1.0e-8f)));
}

/// What fading leaves on the way through `behind` fibres and back.
VELLUS_FN vec3 dual_end(vec3 k, float behind) { return exp2(k * (-2.0f * kLog2E * behind)); }

/// F of a beam, n fibres deep in hair that ends further on; `k` is dual_fading's, `end` dual_end's.
VELLUS_FN vec3 dual_onward(vec3 f, vec3 b, vec3 k, float n, vec3 end) {
    vec3 r = b / (vec3(1.0f) - f + k);
    vec3 r2 = r * r;
    vec3 through = exp2(k * (-kLog2E * n));
    return through * (vec3(1.0f) - r2 * end) / (vec3(1.0f) - r2 * end * through * through);
}

/// R - a_b of a fibre with hair behind it: R∞ - a_b where that is a half space, and less where light comes
/// to an end; `end` is dual_end's, 0 for a half space.
VELLUS_FN vec3 dual_backscatter(vec3 f, vec3 b, vec3 end) {
    vec3 f2 = f * f;
    vec3 b2 = b * b;
    vec3 root = (vec3(1.0f) - b - f) * (vec3(1.0f) - b + f) * (vec3(1.0f) + b - f) * (vec3(1.0f) + b + f);
    vec3 half_space = 2.0f * b / (vec3(1.0f) + b2 - f2 + sqrt(max(root, vec3(0.0f))));
    vec3 behind = half_space * (vec3(1.0f) - end) / (vec3(1.0f) - half_space * half_space * end);
    return f2 * behind / (vec3(1.0f) - b * behind);
}

/// M of tier B for one lobe of variance v >= 1e-6 around the mirrored inclination `e` turned by `tilt`.
VELLUS_FN float dual_longitudinal(float v, float tilt, HairFrame f, float sin_i, float cos_i) {
    float cos_tilt = sqrt(1.0f - tilt * tilt);
    float sine = f.sin_r * cos_tilt - f.cos_r * tilt;
    float cosine = abs(f.cos_r * cos_tilt + f.sin_r * tilt);
    float inverse = 1.0f / v;
    float exponent = (square(sine + sin_i) + square(cosine - cos_i)) * inverse;
    float bessel = bessel_i0e_b(vec3(cos_i * cosine * inverse)).x;
    return exp2(-0.5f * kLog2E * exponent) * bessel * inverse /
           (1.0f - exp2(-2.0f * kLog2E * inverse));
}

/// Single scattering of light that forward scattering has spread over the front half of azimuths and by
/// `variance` along the fibre: each cosine term meets a box of ±90°, sin(kπ/2) / (kπ/2).
VELLUS_FN vec3 dual_spread_bsdf(VELLUS_IN(HairFibre) fibre, HairSurface s, HairEye e, HairAngles a,
                                vec3 half_log, float variance) {
    vec3 v = vec3(1.0f) / fibre.inverse_v + vec3(variance);
    vec3 inverse = vec3(1.0f) / v;
    vec3 along = e.sine + vec3(a.sin_i);
    vec3 across = e.cosine - vec3(a.cos_i);
    vec3 exponent = (along * along + across * across) * inverse;
    vec3 m = exp2(-0.5f * kLog2E * exponent) * bessel_i0e_b(a.cos_i * e.cosine * inverse) * inverse /
             (vec3(1.0f) - exp2(-2.0f * kLog2E * inverse));
    float u = a.cos_d / (a.cos_d + kGrazing);
    float u2 = u * u;
    float c3 = a.cos_phi * (4.0f * a.cos_phi * a.cos_phi - 3.0f);
    vec4 low = vec4(1.0f, 0.636619772f * a.cos_phi, 0.0f, -0.212206591f * c3);
    float tt_short = u2 * dot(fibre.tt[0] + u * (fibre.tt[1] + u * fibre.tt[2]), low);
    float tt_long = u2 * dot(fibre.tt[3] + u * (fibre.tt[4] + u * fibre.tt[5]), low);
    float trt = u2 * dot(fibre.trt[0] + u * (fibre.trt[1] + u * fibre.trt[2]), low);
    // ¼ |cos φ/2| through the box is .159 + .066 cos φ within .001; F at its mean cosine.
    float r = 2.0f * s.specular * (0.1592f + 0.0659f * a.cos_phi) *
              fresnel_exact(fibre.index2_1, 0.785f * a.cos_d);
    vec3 path_short = exp2(half_log * kPathShort);
    vec3 path_long = exp2(half_log * kPathLong);
    vec3 tt = max(path_short * tt_short + path_long * tt_long, vec3(0.0f));
    return vec3(m.x * r) + m.y * tt + m.z * (path_short * path_long * max(trt, 0.0f));
}

/// Multiple scattering per unit irradiance of the unshadowed beam; `shadow` in [0, 1] is the hair's alone,
/// `behind` >= 0 the mean number of fibres behind this one, seen from the light.
VELLUS_FN vec3 dual_scattering(VELLUS_IN(HairFibre) fibre, HairSurface s, HairFrame f, HairEye e,
                               vec3 to_light, float shadow, float behind) {
    HairAngles a = hair_angles(f, to_light);
    float cos2_t = 1.0f - a.sin_i * a.sin_i * fibre.inverse_index2;
    vec3 half_log = hair_log2_color(s.base_color) * (0.5f * inversesqrt(cos2_t));
    HairAverages m = hair_averages(fibre, s, half_log, a.cos_i);
    float n = min(-log(max(shadow, 1.0e-30f)), kDualMostFibres);
    vec3 k = dual_fading(m.forward, m.backward);
    vec3 end = dual_end(k, min(behind, kDualMostFibres));
    vec3 passed = dual_onward(m.forward, m.backward, k, n, end) - vec3(exp2(-kLog2E * n));
    passed = max(passed, vec3(0.0f));

    // Mean number of forward scatterings of light that had at least one: x / (1 - e^-x), x = n a_f.
    float mean_forward = dot(m.forward, vec3(1.0f / 3.0f));
    float x = n * mean_forward;
    float count = x > 1.0e-3f ? x / (1.0f - exp2(-kLog2E * x)) : 1.0f + 0.5f * x;
    float spread = m.forward_variance * count;

    float ab = dot(m.backward, vec3(1.0f / 3.0f));
    float ab3 = ab * ab * ab;
    float f2 = mean_forward * mean_forward;
    // Zinke, eq. 22, with 3 β_b² under the second root.
    float one = sqrt(2.0f * m.forward_variance + m.backward_variance);
    float three = sqrt(2.0f * m.forward_variance + 3.0f * m.backward_variance);
    float deviation = (1.0f + 0.7f * f2) * (ab * one + ab3 * three) /
                      (ab + ab3 * (2.0f * sqrt(m.forward_variance) + 3.0f * sqrt(m.backward_variance)));
    // Zinke, eq. 21; it grows without bound as a_f -> 1.
    float through = 1.0f - f2;
    float tilt = m.backward_tilt * (1.0f - 2.0f * ab * ab / (through * through)) +
                 m.forward_tilt * (2.0f * through * through + 4.0f * f2 * ab * ab) /
                     (through * through * through);
    tilt = clamp(tilt, -kDualMostTilt, kDualMostTilt);

    vec3 back = dual_backscatter(m.forward, m.backward, end);
    float v = deviation * deviation;
    // Turned back light leaves as from a matt surface, ½ cos φ; light that comes from all of
    // the front half as (1 + cos φ) / 2π.
    float lobe_direct = dual_longitudinal(v, tilt, f, a.sin_i, a.cos_i) * max(0.5f * a.cos_phi, 0.0f);
    float lobe_spread = dual_longitudinal(v + spread, tilt, f, a.sin_i, a.cos_i) *
                        (1.0f + a.cos_phi) * (0.5f * kInvPi);
    vec3 direct = back * (lobe_direct * shadow);
    vec3 scattered = passed * (dual_spread_bsdf(fibre, s, e, a, half_log, spread) + back * lobe_spread);
    return (direct + scattered) * s.scatter;
}

#endif
