// Equirectangular environment images, OpenEXR's "latlong" (ImfEnvmap.h): +Y is the top row, the image's
// centre is +Z, its left and right edges meet at -Z, and a quarter in from the left is +X. Seen from inside,
// looking along +Z with +Y up, the right-hand side is -X: nothing is mirrored.
#ifndef VELLUS_LIGHT_EQUIRECT_GLSL
#define VELLUS_LIGHT_EQUIRECT_GLSL
#include "common/portable.glsl"

/// uv in [0, 1]², v = 0 at the top, of a direction of any length but zero (zero gives the centre).
VELLUS_FN vec2 equirect_uv(vec3 d) {
    float across = sqrt(d.x * d.x + d.z * d.z);
    float longitude = across > 0.0f ? atan(d.x, d.z) : 0.0f;
    float latitude = (across > 0.0f || d.y != 0.0f) ? atan(d.y, across) : 0.0f;
    return vec2(0.5f - longitude * (0.5f * kInvPi), 0.5f - latitude * kInvPi);
}

VELLUS_FN vec3 equirect_direction(vec2 uv) {
    float longitude = (0.5f - uv.x) * (2.0f * kPi);
    float latitude = (0.5f - uv.y) * kPi;
    float across = cos(latitude);
    return vec3(across * sin(longitude), sin(latitude), across * cos(longitude));
}

#endif
