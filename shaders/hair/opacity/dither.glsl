// Dithered opacity: a fragment is kept where its alpha exceeds a threshold, so that the mean over frames
// (and over pixels) is its coverage, without sorting (B. Karis, SIGGRAPH 2016, "Hair AA / translucency").
#ifndef VELLUS_HAIR_DITHER_GLSL
#define VELLUS_HAIR_DITHER_GLSL
#include "common/portable.glsl"

/// Start of a strand's sequence in a pixel: the R2 lattice (M. Roberts 2018) spreads neighbouring pixels
/// evenly, the strand's hash moves the lattice.
VELLUS_FN uint dither_seed(uvec2 pixel, uint strand) {
    return pixel.x * 0xC13FA9A9u + pixel.y * 0x91E10DA5u + hash_uint(strand + 1u);
}

/// Threshold in [0, 1) of a strand in a pixel at a frame. Steps by the golden ratio fill [0, 1) evenly
/// over any run of frames.
VELLUS_FN float dither_threshold(uvec2 pixel, uint frame, uint strand) {
    return unit_float(dither_seed(pixel, strand) + frame * 0x9E3779B9u);
}

/// As above without frames, for pictures without a history.
VELLUS_FN float dither_threshold_still(uvec2 pixel, uint strand) {
    return unit_float(dither_seed(pixel, strand));
}

/// Keeps a fragment of coverage `alpha`: never at 0, always at 1.
VELLUS_FN bool dither_keeps(float alpha, float threshold) { return alpha > threshold; }

/// Width to draw and alpha of a strand `width` pixels across: never thinner than a pixel, so that none
/// falls between the samples; alpha makes up for it.
VELLUS_FN float strand_drawn_width(float width) { return max(width, 1.0f); }
VELLUS_FN float strand_alpha(float width) { return saturate(width); }

#endif
