// What the techniques beyond Karis's need to know of a fibre and share among all pixels of a groom; made
// on the CPU (modules/hair/scattering/fibre.h) when a material changes.
#ifndef VELLUS_HAIR_FIBRE_GLSL
#define VELLUS_HAIR_FIBRE_GLSL
#include "hair/scattering/karis.glsl"

/// Components of a vec3 are the lobes R, TT, TRT.
struct HairFibre {
    vec3 inverse_v;    // 1/β²
    float index2_1;    // η² - 1
    vec3 peak;         // 1 / (v (1 - e^(-2/v)))
    float inverse_index2;
    vec3 sin_tilt;     // of the angle each lobe is turned along the fibre
    float detector_tt; // deviation of the azimuthal detectors, radians
    vec3 cos_tilt;
    float detector_trt;
    vec4 tt[6];   // hair/scattering/azimuthal.glsl: by path [0, 3) and [3, 6), then degree
    vec4 trt[6];  // by k < 4 and k >= 4, then degree
    // Shares of each lobe that go on and turn back (hair/scattering/dual.glsl), in u: R's cubics, then
    // TT's two paths and TRT like the series.
    vec4 r_forward;
    vec4 r_backward;
    vec3 forward[3];
    vec3 backward[3];
};

/// The eye's inclination as each lobe sees it: turned by its tilt.
struct HairEye {
    vec3 sine;
    vec3 cosine;  // >= 0: an inclination turned past 90° counts with |cos|
};

VELLUS_FN HairEye hair_eye(VELLUS_IN(HairFibre) fibre, HairFrame f) {
    HairEye e;
    e.sine = f.sin_r * fibre.cos_tilt - f.cos_r * fibre.sin_tilt;
    e.cosine = abs(f.cos_r * fibre.cos_tilt + f.sin_r * fibre.sin_tilt);
    return e;
}

/// Reflectance of unpolarised light at `cosine` >= 0 from outside; index2_1 = η² - 1 > 0.
VELLUS_FN float fresnel_exact(float index2_1, float cosine) {
    float c = min(cosine, 1.0f);
    float g = sqrt(index2_1 + c * c);
    float sum = g + c;
    float difference = g - c;
    float along = c * sum - 1.0f;
    float across = c * difference + 1.0f;
    // ½ ((g - c) / (g + c))² (1 + ((c(g + c) - 1) / (c(g - c) + 1))²) over one denominator.
    float bottom = sum * across;
    return 0.5f * square(difference / bottom) * (square(across) + square(along));
}

#endif
