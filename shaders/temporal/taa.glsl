// Temporal antialiasing: resolve of one pixel, without texture access.
// Sources: B. Karis, "High Quality Temporal Supersampling", SIGGRAPH 2014 (YCoCg box, luminance
// weight); J. Jimenez, "Filmic SMAA", SIGGRAPH 2016 (Catmull-Rom without corners).
// Colours are pre-exposed linear RGB. Texels of the frame go through taa_load, which marks garbage so that it
// enters neither box nor history; texels of the history through taa_sanitize.
#ifndef VELLUS_TEMPORAL_TAA_GLSL
#define VELLUS_TEMPORAL_TAA_GLSL
#include "common/portable.glsl"

const float kTaaPlain = 2.0f;   // pre-exposed luminance up to which every frame counts alike
const float kTaaMax = 1024.0f;  // pre-exposed white is about 1; keeps fp16 history exact enough

/// Black for NaN and infinity, else clamped to [0, kTaaMax].
VELLUS_FN vec3 taa_sanitize(vec3 c) {
    return is_finite(c) ? clamp(c, vec3(0.0f), vec3(kTaaMax)) : vec3(0.0f);
}

VELLUS_FN vec3 rgb_to_ycocg(vec3 c) {
    return vec3(0.25f * c.x + 0.5f * c.y + 0.25f * c.z, 0.5f * (c.x - c.z),
                -0.25f * c.x + 0.5f * c.y - 0.25f * c.z);
}

VELLUS_FN vec3 ycocg_to_rgb(vec3 c) {
    float t = c.x - c.z;
    return vec3(t + c.y, c.x + c.z, t - c.y);
}

/// A texel of the current frame in YCoCg; NaN, infinity, what no half float holds and light below what rounding
/// explains are marked by Y = -1.
VELLUS_FN vec3 taa_load(vec3 c) {
    bool usable = is_finite(c) && max(c.x, max(c.y, c.z)) < 65000.0f && min(c.x, min(c.y, c.z)) > -0.01f;
    return usable ? rgb_to_ycocg(clamp(c, vec3(0.0f), vec3(kTaaMax))) : vec3(-1.0f, 0.0f, 0.0f);
}

VELLUS_FN bool taa_is_usable(vec3 ycocg) { return ycocg.x >= 0.0f; }

/// Bounds of the neighbourhood in YCoCg: start with taa_box_start, add each tap. Marked taps do not count;
/// where all are marked the box is empty (low above high).
struct TaaBox {
    vec3 low;
    vec3 high;
};

VELLUS_FN void taa_box_add(VELLUS_INOUT(TaaBox) box, vec3 ycocg) {
    bool usable = taa_is_usable(ycocg);
    box.low = min(box.low, usable ? ycocg : vec3(1.0e30f));
    box.high = max(box.high, usable ? ycocg : vec3(-1.0e30f));
}

VELLUS_FN TaaBox taa_box_start(vec3 ycocg) {
    TaaBox box;
    box.low = vec3(1.0e30f);
    box.high = vec3(-1.0e30f);
    taa_box_add(box, ycocg);
    return box;
}

/// `history` inside the box, channel by channel; an empty box leaves it. Not along the line to the box's
/// centre: where a grey neighbourhood makes the box a needle that moves luma by the box's length over its width
/// times what the chroma is off, and rounding to half floats grows to visible steps that no frame forgets.
VELLUS_FN vec3 taa_clamp(TaaBox box, vec3 history) {
    return box.low.x > box.high.x ? history : clamp(history, box.low, box.high);
}

/// Karis's weight against fireflies, only above kTaaPlain: below, where bright dithered strands over a dark
/// background (or dark over bright) lie, the mean of frames has to be the coverage.
/// Far above, where a single pixel of one frame is garbage more often than light, nothing of it is left.
VELLUS_FN float taa_weight(float luma) {
    float above = max(luma - kTaaPlain, 0.0f);
    return 1.0f / (1.0f + above + above * above * 0.015625f);
}

/// New history, linear RGB. `current` and `history` are YCoCg, `history` already clamped; `blend` in
/// [0, 1] is the share of the current frame: 1 where there is no history. A marked `current` leaves the
/// history as it is, or black where there is none.
VELLUS_FN vec3 taa_resolve(vec3 current, vec3 history, float blend) {
    if (!taa_is_usable(current)) {
        return blend < 1.0f ? max(ycocg_to_rgb(history), vec3(0.0f)) : vec3(0.0f);
    }
    float wc = blend * taa_weight(current.x);
    float wh = (1.0f - blend) * taa_weight(history.x);
    return max(ycocg_to_rgb(mix(history, current, wc / (wc + wh))), vec3(0.0f));
}

/// Dithered strands as thin as this: the share of a history's memory of hair that one frame without any hair
/// in the window takes away; while some is left its colour is not clamped.
const float kTaaForget = 0.26f;
/// What moves leaves a ghost, so only hair that stays where it was is remembered.
VELLUS_FN float taa_memory(bool hair, bool still, float before) {
    if (!still) return 0.0f;
    return hair ? 1.0f : max(before - kTaaForget, 0.0f);
}

/// 1 (take the current frame alone) where last frame's position lies outside the image, else `blend`.
VELLUS_FN float taa_blend(vec2 previous_uv, float blend) {
    bool inside = previous_uv.x >= 0.0f && previous_uv.y >= 0.0f && previous_uv.x <= 1.0f &&
                  previous_uv.y <= 1.0f;
    return inside ? blend : 1.0f;
}

/// Catmull-Rom weights of four texels side by side, from texel `first` on.
struct TaaCubic {
    int first;
    vec4 weight;  // sum to 1
};

/// For a position in texels from the edge; a texel's centre is half a texel in.
VELLUS_FN TaaCubic taa_catmull_rom(float position) {
    float centre = floor(position - 0.5f);
    float f = position - 0.5f - centre;
    TaaCubic c;
    c.first = int(centre) - 1;
    c.weight.x = f * (f * (1.0f - 0.5f * f) - 0.5f);
    c.weight.y = f * f * (1.5f * f - 2.5f) + 1.0f;
    c.weight.z = f * (f * (2.0f - 1.5f * f) + 0.5f);
    c.weight.w = f * f * (0.5f * f - 0.5f);
    return c;
}

#endif
