// Dithered opacity: a fragment is kept where its alpha exceeds a threshold, so that the mean over frames
// (and over pixels) is its coverage, without sorting (B. Karis, SIGGRAPH 2016, "Hair AA / translucency").
#ifndef VELLUS_HAIR_DITHER_GLSL
#define VELLUS_HAIR_DITHER_GLSL
#include "common/portable.glsl"

/// A strand's own sequence; one per strand, then a few multiplications per fragment.
///
/// In time it steps by a quadratic irrational, so any run of frames fills [0, 1) evenly. Strands take one
/// of eight steps from independent fields: with one common step two strands would keep a fixed relation
/// for ever and their joint coverage would be wrong by .075 (RMS) instead of .03. In the image it is the
/// R2 lattice (M. Roberts 2018), turned per strand, so neighbouring pixels spread evenly too.
struct DitherStrand {
    uint offset;
    uint step_x;
    uint step_y;
    uint step_frame;
};

VELLUS_FN DitherStrand dither_strand(uint strand) {
    DitherStrand d;
    d.offset = hash_uint(strand + 1u);
    bool turn = (d.offset & 8u) != 0u;
    uint a = (d.offset & 16u) != 0u ? 0x3EC05657u : 0xC13FA9A9u;  // -+ 0.7548776662, R2's first
    uint b = 0x91E10DA5u;                                         // 0.5698402910, R2's second
    d.step_x = turn ? b : a;
    d.step_y = turn ? a : b;
    bool odd = (d.offset & 1u) != 0u;
    uint low = (d.offset & 2u) != 0u ? (odd ? 0x9E3779B9u : 0x6A09E667u)   // golden ratio, √2
                                     : (odd ? 0xBB67AE85u : 0x4D82B447u);  // √3, (√13 - 3) / 2
    uint high = (d.offset & 2u) != 0u ? (odd ? 0x8FC1ECD5u : 0xCA91D723u)  // (√17 - 3) / 2, (√21 - 3) / 2
                                      : (odd ? 0xA54FF53Bu : 0x7311C281u);  // √7, √6
    d.step_frame = (d.offset & 4u) != 0u ? low : high;
    return d;
}

/// Threshold in [0, 1) of a strand in a pixel at a frame.
VELLUS_FN float dither_threshold(DitherStrand d, uvec2 pixel, uint frame) {
    return unit_float(d.offset + pixel.x * d.step_x + pixel.y * d.step_y + frame * d.step_frame);
}

/// As above without frames, for pictures without a history.
VELLUS_FN float dither_threshold_still(DitherStrand d, uvec2 pixel) {
    return dither_threshold(d, pixel, 0u);
}

/// Keeps a fragment of coverage `alpha`: never at 0, always at 1.
VELLUS_FN bool dither_keeps(float alpha, float threshold) { return alpha > threshold; }

/// Width to draw and alpha of a strand `width` pixels across: never thinner than a pixel, so that none
/// falls between the samples; alpha makes up for it.
VELLUS_FN float strand_drawn_width(float width) { return max(width, 1.0f); }
VELLUS_FN float strand_alpha(float width) { return saturate(width); }

#endif
