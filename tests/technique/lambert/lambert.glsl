// A matt, opaque cylinder: Lambert's law averaged over the width that the eye sees.
//   S = C cos θi ((π - |φ|) cos φ + sin |φ|) / (4π)
#ifndef LAMBERT_GLSL
#define LAMBERT_GLSL
#include "hair/scattering/karis.glsl"

/// S [1/sr] for a beam from `to_light` (unit).
VELLUS_FN vec3 lambert_bsdf(HairSurface s, HairFrame f, vec3 to_light) {
    HairAngles a = hair_angles(f, to_light);
    float phi = acos(clamp(a.cos_phi, -1.0f, 1.0f));
    float seen = (kPi - phi) * a.cos_phi + safe_sqrt(1.0f - a.cos_phi * a.cos_phi);
    return s.base_color * (0.25f * kInvPi * a.cos_i * max(seen, 0.0f));
}

#endif
