// What hair around a point of a surface leaves of the sky there. A share of the sky's light, weighted as the
// surface takes it in, meets no hair; the rest passes hair of one optical depth by A. Schuster's two streams
// ("Radiation through a Foggy Atmosphere", 1905), so that light which fibres turn back and on again arrives
// too: light hair lets more through than black hair. Both are fitted to rays through the groom when it is first
// drawn (modules/hair/environment/mesh_cover.h).
#ifndef VELLUS_HAIR_COVER_GLSL
#define VELLUS_HAIR_COVER_GLSL
#include "hair/scattering/dual.glsl"

/// Share that arrives: `open` of the sky is free, and fibres that pass on `forward` and turn back `backward`
/// hide the rest by `depth`.
VELLUS_FN vec3 cover_share(float open, float depth, vec3 forward, vec3 backward) {
    vec3 k = dual_fading(forward, backward);
    vec3 through = dual_onward(forward, backward, k, depth, vec3(1.0f));
    return vec3(open) + (1.0f - open) * through;
}

#endif
