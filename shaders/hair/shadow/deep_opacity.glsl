// Deep opacity maps: optical depth of hair in layers behind the closest hair of each texel of a light's
// map, added up where they lie, so that a fragment knows how much hair is in front of it.
// Source: C. Yuksel and J. Keyser, "Deep Opacity Maps", Eurographics 2008. Layers get thicker with depth
// as in Ren et al. 2010, section 5: layer k ends at span (k + 1) (k + 2) / (L (L + 1)), k < L; one more
// holds what lies behind, up to kDeepReach spans.
// Transmittances are averaged over texels, not depths (see pcf_exponential.glsl).
#ifndef VELLUS_HAIR_DEEP_OPACITY_GLSL
#define VELLUS_HAIR_DEEP_OPACITY_GLSL
#include "common/portable.glsl"

const uint kDeepLayers = 10u;
/// A texel's words: bits of the reversed depth of the first layer, optical depth before it, then layers.
const uint kDeepBefore = 1u;
const uint kDeepFirst = 2u;
const uint kDeepWords = 12u;
/// Optical depths are added as integers: one is this many.
const float kDeepUnit = 4096.0f;

/// The last layer ends at so many spans.
const float kDeepReach = 10.0f / 3.0f;

/// Where a depth behind the first layer's front falls: layer and share of it in front. `depth` >= 0 and
/// `span` > 0 in metres; depths beyond the last layer's end are its end.
struct DeepPlace {
    uint layer;
    float share;
};

VELLUS_FN DeepPlace deep_place(float depth, float span) {
    const float count = float(kDeepLayers - 1u);
    DeepPlace place;
    if (depth >= span) {
        place.layer = kDeepLayers - 1u;
        place.share = min((depth / span - 1.0f) / (kDeepReach - 1.0f), 1.0f);
        return place;
    }
    float x = depth / span * (count * (count + 1.0f));
    // k (k + 1) <= x, and its rounding errors at the ends of layers do no harm.
    float k = clamp(floor(0.5f * (sqrt(1.0f + 4.0f * x) - 1.0f)), 0.0f, count - 1.0f);
    place.layer = uint(k);
    place.share = clamp((x - k * (k + 1.0f)) / (2.0f * (k + 1.0f)), 0.0f, 1.0f);
    return place;
}

/// Optical depth of what stops a share of the light: of strands that each cover p of a texel, anywhere in
/// it, n let (1 - p)^n through.
VELLUS_FN float deep_optical_depth_of(float share) { return -log(1.0f - clamp(share, 0.0f, 0.999f)); }

/// Optical depth in units of kDeepUnit; at least 0.
VELLUS_FN uint deep_units(float optical_depth) { return uint(max(optical_depth, 0.0f) * kDeepUnit + 0.5f); }

#endif
