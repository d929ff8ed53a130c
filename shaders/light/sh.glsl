// Environment lighting in spherical harmonics of order 3 (nine coefficients per channel).
// Source: R. Ramamoorthi and P. Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
// SIGGRAPH 2001, with +Y as the polar axis. The coefficients are those of irradiance/π with all constants
// folded in (modules/light/sh.h), so a constant white environment gives exactly 1.
#ifndef VELLUS_LIGHT_SH_GLSL
#define VELLUS_LIGHT_SH_GLSL
#include "common/portable.glsl"

/// Factors of 1, x, y, z, xy, yz, 2y² - x² - z², xz, z² - x².
struct Sh9 {
    vec3 c[9];
};

/// irradiance/π for a surface facing `n` (length 0 to 1: shorter vectors fade to the mean), >= 0. A lone
/// sun makes the truncated series dip to -4 % of its peak; that is cut at 0.
VELLUS_FN vec3 sh_irradiance_over_pi(Sh9 sh, vec3 n) {
    vec3 r = sh.c[0] + sh.c[1] * n.x + sh.c[2] * n.y + sh.c[3] * n.z;
    r += sh.c[4] * (n.x * n.y) + sh.c[5] * (n.y * n.z) + sh.c[7] * (n.x * n.z);
    r += sh.c[6] * (2.0f * n.y * n.y - n.x * n.x - n.z * n.z) + sh.c[8] * (n.z * n.z - n.x * n.x);
    return max(r, vec3(0.0f));
}

#endif
