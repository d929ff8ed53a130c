#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/hair_mark.glsl"
#include "temporal/taa.glsl"

// One pixel of the new history from this frame's picture and last frame's history.
// Thin dithered strands are absent from most frames of a pixel and often from all of a 3x3 neighbourhood, whose
// box would wipe them out of the history; so near hair the box is that of a wider window, and where even
// that has none for a moment, the history's alpha remembers that it had.
// A CPU device runs both sides of a branch, so where no hair can be all this is compiled out.
layout(constant_id = 0) const bool kNearHair = true;
const int kTile = 16, kBorder = kNearHair ? 2 : 1, kWide = kTile + 2 * kBorder;
layout(local_size_x = 16, local_size_y = 16) in;
layout(push_constant) uniform Push {
    ivec2 size;
    ivec2 first;  // pixels to resolve
    ivec2 end;
    vec2 inverse_size;
    float blend;
    uint history_valid;
};
layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D velocity;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D history;
layout(binding = 4, rgba16f) uniform writeonly image2D result;

// The tile's pixels with a border, in YCoCg; a texel is fetched once for all neighbours.
shared vec3 tile[kWide * kWide];
shared float front[kWide * kWide];  // reversed depth; kHair, nearer than anything, where hair was drawn
const int kRuns = kNearHair ? kTile * kWide : 1;
shared vec3 low[kRuns];  // of each run of 2 kBorder + 1 pixels in a row
shared vec3 high[kRuns];
shared uint has_hair[kRuns];

const float kHair = 2.0;

void load_tile() {
    ivec2 corner = first + ivec2(gl_WorkGroupID.xy) * kTile - kBorder;
    for (uint i = gl_LocalInvocationIndex; i < tile.length(); i += kTile * kTile) {
        ivec2 at = clamp(corner + ivec2(i % kWide, i / kWide), ivec2(0), size - 1);
        vec4 texel = texelFetch(color, at, 0);
        tile[i] = taa_load(texel.rgb);
        front[i] = kNearHair && texel.a == kHairMark ? kHair : texelFetch(depth, at, 0).x;
    }
    barrier();
}

// Boxes of the runs in rows, for load_window.
void load_runs() {
    for (uint i = gl_LocalInvocationIndex; i < low.length(); i += kTile * kTile) {
        uint start = i / kTile * kWide + i % kTile;
        TaaBox box = taa_box_start(tile[start]);
        bool hair = front[start] == kHair;
        for (uint k = 1; k < 2 * kBorder + 1; ++k) {
            taa_box_add(box, tile[start + k]);
            hair = hair || front[start + k] == kHair;
        }
        low[i] = box.low;
        high[i] = box.high;
        has_hair[i] = hair ? 1u : 0u;
    }
    barrier();
}

// Catmull-Rom where the history falls between pixels, else the pixel itself.
vec4 read_history(ivec2 pixel, vec2 uv, bool still) {
    if (still) return texelFetch(history, pixel, 0);
    TaaTaps t = taa_catmull_rom(uv, vec2(size));
    vec3 sum = texture(history, vec2(t.uv12.x, t.uv0.y)).rgb * t.weight_up +
               texture(history, vec2(t.uv0.x, t.uv12.y)).rgb * t.weight_left +
               texture(history, t.uv12).rgb * t.weight_centre +
               texture(history, vec2(t.uv3.x, t.uv12.y)).rgb * t.weight_right +
               texture(history, vec2(t.uv12.x, t.uv3.y)).rgb * t.weight_down;
    return vec4(sum / (t.weight_up + t.weight_left + t.weight_centre + t.weight_right + t.weight_down), 0.0);
}

// Box of the window around a pixel, from its runs, and whether there is hair in it.
bool load_window(ivec2 local, inout TaaBox window) {
    bool hair = false;
    for (int k = 0; k < 2 * kBorder + 1; ++k) {
        int run = (local.y + k) * kTile + local.x;
        window.low = min(window.low, low[run]);
        window.high = max(window.high, high[run]);
        hair = hair || has_hair[run] != 0u;
    }
    return hair;
}

void main() {
    load_tile();
    if (kNearHair) load_runs();
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    ivec2 pixel = first + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, end))) return;
    int at = (local.y + kBorder) * kWide + local.x + kBorder;
    vec3 current = tile[at];
    TaaBox box = taa_box_start(current);
    // Where something moves in front of another, its edge moves with it: the nearest neighbour's velocity.
    ivec2 nearest = ivec2(0);
    float nearest_depth = front[at];
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            int neighbour = at + y * kWide + x;
            taa_box_add(box, tile[neighbour]);
            if (!kNearHair && (x == 0 || y == 0)) continue;  // Karis 2014: the corners tell
            nearest = front[neighbour] > nearest_depth ? ivec2(x, y) : nearest;
            nearest_depth = max(nearest_depth, front[neighbour]);
        }
    }
    bool hair = false;
    if (kNearHair) {
        TaaBox window = box;
        hair = load_window(local, window);
        if (hair) box = window;
    }
    vec2 moved = texelFetch(velocity, clamp(pixel + nearest, ivec2(0), size - 1), 0).xy;
    vec2 uv = (vec2(pixel) + 0.5 - moved) * inverse_size;
    float share = history_valid != 0u ? taa_blend(uv, blend) : 1.0;
    bool still = moved == vec2(0.0);
    float memory = kNearHair ? taa_memory(nearest_depth == kHair, still, 0.0) : 0.0;
    vec3 before = current;
    if (share < 1.0) {
        vec4 kept = read_history(pixel, uv, still);
        // The window's hair keeps the memory but does not begin one.
        if (kNearHair) memory = max(memory, hair && still ? kept.a : taa_memory(false, still, kept.a));
        before = rgb_to_ycocg(taa_sanitize(kept.rgb));
        if (hair || memory == 0.0) before = taa_clamp(box, before);
    }
    imageStore(result, pixel, vec4(taa_resolve(current, before, share), memory));
}
