#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/hair_mark.glsl"
#include "temporal/taa.glsl"

// One pixel of the new history from this frame's picture and last frame's history.
// Thin dithered strands are absent from most frames of a pixel and often from all of a 3x3 neighbourhood, whose
// box would wipe them out of the history; so near hair the box is that of a wider window, and where even
// that has none for a moment, the history's alpha remembers that it had.
const int kTile = 16, kBorder = 2, kWide = kTile + 2 * kBorder;
layout(local_size_x = 16, local_size_y = 16) in;
layout(push_constant) uniform Push {
    ivec2 size;
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
shared vec3 low[kTile * kWide];     // of each run of 2 kBorder + 1 pixels in a row; only where there is hair
shared vec3 high[kTile * kWide];
shared uint has_hair[kTile * kWide];
shared uint any_hair;

const float kHair = 2.0;

void load_tile() {
    if (gl_LocalInvocationIndex == 0) any_hair = 0u;
    barrier();
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile - kBorder;
    bool seen = false;
    for (uint i = gl_LocalInvocationIndex; i < tile.length(); i += kTile * kTile) {
        ivec2 at = clamp(corner + ivec2(i % kWide, i / kWide), ivec2(0), size - 1);
        vec4 texel = texelFetch(color, at, 0);
        bool hair = texel.a == kHairMark;
        tile[i] = taa_load(texel.rgb);
        front[i] = hair ? kHair : texelFetch(depth, at, 0).x;
        seen = seen || hair;
    }
    if (seen) atomicOr(any_hair, 1u);
    barrier();
}

// Boxes of the runs in rows, for load_window.
void load_runs() {
    for (uint i = gl_LocalInvocationIndex; i < low.length(); i += kTile * kTile) {
        uint first = i / kTile * kWide + i % kTile;
        TaaBox box = taa_box_start(tile[first]);
        bool hair = front[first] == kHair;
        for (uint k = 1; k < 2 * kBorder + 1; ++k) {
            taa_box_add(box, tile[first + k]);
            hair = hair || front[first + k] == kHair;
        }
        low[i] = box.low;
        high[i] = box.high;
        has_hair[i] = hair ? 1u : 0u;
    }
    barrier();
}

// Catmull-Rom where the history falls between pixels, else the pixel itself.
vec3 read_history(vec2 uv, vec2 moved) {
    if (moved == vec2(0.0)) return taa_sanitize(texelFetch(history, ivec2(gl_GlobalInvocationID.xy), 0).rgb);
    TaaTaps t = taa_catmull_rom(uv, vec2(size));
    vec3 sum = texture(history, vec2(t.uv12.x, t.uv0.y)).rgb * t.weight_up +
               texture(history, vec2(t.uv0.x, t.uv12.y)).rgb * t.weight_left +
               texture(history, t.uv12).rgb * t.weight_centre +
               texture(history, vec2(t.uv3.x, t.uv12.y)).rgb * t.weight_right +
               texture(history, vec2(t.uv12.x, t.uv3.y)).rgb * t.weight_down;
    return taa_sanitize(sum / (t.weight_up + t.weight_left + t.weight_centre + t.weight_right +
                               t.weight_down));
}

void main() {
    load_tile();
    bool near_hair = any_hair != 0u;
    if (near_hair) load_runs();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    int at = (local.y + kBorder) * kWide + local.x + kBorder;
    vec3 current = tile[at];
    TaaBox box = taa_box_start(current);
    // Where something moves in front of another, its edge moves with it: the nearest neighbour's velocity.
    int nearest = at;
    float nearest_depth = front[at];
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            int neighbour = at + y * kWide + x;
            taa_box_add(box, tile[neighbour]);
            float depth_there = front[neighbour];
            nearest = depth_there > nearest_depth ? neighbour : nearest;
            nearest_depth = max(nearest_depth, depth_there);
        }
    }
    bool hair = false;
    if (near_hair) {
        uint run = uint(local.y) * kTile + local.x;
        TaaBox window = TaaBox(low[run], high[run]);
        for (uint k = 0; k < 2 * kBorder + 1; ++k, run += kTile) {
            window.low = min(window.low, low[run]);
            window.high = max(window.high, high[run]);
            hair = hair || has_hair[run] != 0u;
        }
        if (hair) box = window;
    }
    ivec2 moving = pixel - local - kBorder + ivec2(nearest % kWide, nearest / kWide);
    vec2 moved = texelFetch(velocity, clamp(moving, ivec2(0), size - 1), 0).xy;
    vec2 uv = (vec2(pixel) + 0.5 - moved) * inverse_size;
    float share = history_valid != 0u ? taa_blend(uv, blend) : 1.0;
    bool still = moved == vec2(0.0);
    bool beside_hair = nearest_depth == kHair;
    float memory = taa_memory(beside_hair, still, 0.0);
    vec3 before = current;
    if (share < 1.0) {
        ivec2 from = clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1);
        // The window's hair keeps the memory but does not begin one.
        float kept = texelFetch(history, from, 0).a;
        memory = max(memory, hair && still ? kept : taa_memory(false, still, kept));
        before = rgb_to_ycocg(read_history(uv, moved));
        if (hair || memory == 0.0) before = taa_clamp(box, before);
    }
    imageStore(result, pixel, vec4(taa_resolve(current, before, share), memory));
}
