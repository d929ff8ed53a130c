#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/hair_mark.glsl"
#include "temporal/taa.glsl"

// The new history from this frame's picture and last frame's history. An invocation resolves a column of pixels, top
// down, and so loads each row around them once. On a CPU device this takes half the time of a tile in shared memory
// with filtered history: there every access to shared memory is a loop over lanes, and so is a sampler's choice of a
// mipmap level, which loads from storage images do without.
// Thin dithered strands are absent from most frames of a pixel and often from all of a 3x3 neighbourhood, whose
// box would wipe them out of the history; so near hair the box is that of a wider window, and where even
// that has none for a moment, the history's alpha remembers that it had.
// A CPU device runs both sides of a branch, so where no hair can be all this is compiled out.
layout(constant_id = 0) const bool kNearHair = true;
const int kRows = 16;  // a column's pixels
layout(local_size_x = 32) in;
layout(push_constant) uniform Push {
    ivec2 size;
    ivec2 first;  // pixels to resolve
    ivec2 end;
    vec2 inverse_size;
    float blend;
    uint history_valid;
};
layout(binding = 0, rgba16f) uniform readonly image2D color;
layout(binding = 1, rg16f) uniform readonly image2D velocity;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3, rgba16f) uniform readonly image2D history;
layout(binding = 4, rgba16f) uniform writeonly image2D result;

struct Texel {
    vec3 ycocg;
    float front;  // reversed depth; kHair, nearer than anything, where hair was drawn
};

const float kHair = 2.0;

Texel load_texel(ivec2 at) {
    at = clamp(at, ivec2(0), size - 1);
    vec4 texel = imageLoad(color, at);
    bool hair = kNearHair && texel.a == kHairMark;
    return Texel(taa_load(texel.rgb), hair ? kHair : texelFetch(depth, at, 0).x);
}

// A pixel with its neighbours left and right; near hair the window reaches one further.
struct Row {
    vec3 centre;
    TaaBox box;
    vec3 front;
    TaaBox window;
    bool hair;
};

Row load_row(ivec2 centre) {
    Texel left = load_texel(centre + ivec2(-1, 0)), middle = load_texel(centre),
          right = load_texel(centre + ivec2(1, 0));
    Row row;
    row.centre = middle.ycocg;
    row.box = taa_box_start(middle.ycocg);
    taa_box_add(row.box, left.ycocg);
    taa_box_add(row.box, right.ycocg);
    row.front = vec3(left.front, middle.front, right.front);
    row.window = row.box;
    row.hair = false;
    if (kNearHair) {
        Texel first = load_texel(centre + ivec2(-2, 0)), last = load_texel(centre + ivec2(2, 0));
        taa_box_add(row.window, first.ycocg);
        taa_box_add(row.window, last.ycocg);
        row.hair = max(max(first.front, last.front), max(max(left.front, right.front), middle.front)) == kHair;
    }
    return row;
}

TaaBox around(TaaBox a, TaaBox b) { return TaaBox(min(a.low, b.low), max(a.high, b.high)); }

// Where something moves in front of another, its edge moves with it: the nearest neighbour's velocity.
struct Nearest {
    ivec2 offset;
    float front;
};

void consider(inout Nearest nearest, float front, ivec2 offset) {
    nearest.offset = front > nearest.front ? offset : nearest.offset;
    nearest.front = max(front, nearest.front);
}

Nearest nearest_of(Row above, Row here, Row below) {
    Nearest nearest = Nearest(ivec2(0), here.front.y);
    consider(nearest, above.front.x, ivec2(-1, -1));
    if (kNearHair) consider(nearest, above.front.y, ivec2(0, -1));
    consider(nearest, above.front.z, ivec2(1, -1));
    if (kNearHair) {  // elsewhere the corners tell (Karis 2014)
        consider(nearest, here.front.x, ivec2(-1, 0));
        consider(nearest, here.front.z, ivec2(1, 0));
    }
    consider(nearest, below.front.x, ivec2(-1, 1));
    if (kNearHair) consider(nearest, below.front.y, ivec2(0, 1));
    consider(nearest, below.front.z, ivec2(1, 1));
    return nearest;
}

vec3 history_texel(ivec2 at) { return imageLoad(history, clamp(at, ivec2(0), size - 1)).rgb; }

// Two texels in the middle of a row of the filter's, and the two beside them.
vec3 inner_texels(ivec2 first, vec4 weight) {
    return history_texel(first + ivec2(1, 0)) * weight.y + history_texel(first + ivec2(2, 0)) * weight.z;
}

vec3 outer_texels(ivec2 first, vec4 weight) {
    return history_texel(first) * weight.x + history_texel(first + ivec2(3, 0)) * weight.w;
}

// Catmull-Rom without the corners, which weigh next to nothing (Jimenez 2016), where the history falls between
// pixels, else the pixel itself.
vec4 read_history(ivec2 pixel, vec2 uv, bool still) {
    if (still) return imageLoad(history, pixel);
    TaaCubic x = taa_catmull_rom(uv.x * float(size.x)), y = taa_catmull_rom(uv.y * float(size.y));
    ivec2 first = ivec2(x.first, y.first);
    vec3 sum = inner_texels(first, x.weight) * y.weight.x;
    for (int row = 1; row <= 2; ++row) {
        ivec2 at = first + ivec2(0, row);
        sum += (inner_texels(at, x.weight) + outer_texels(at, x.weight)) * y.weight[row];
    }
    sum += inner_texels(first + ivec2(0, 3), x.weight) * y.weight.w;
    float corners = (x.weight.x + x.weight.w) * (y.weight.x + y.weight.w);
    return vec4(sum / (1.0 - corners), 0.0);
}

void resolve(ivec2 pixel, vec3 current, Nearest nearest, TaaBox box, TaaBox window, bool hair) {
    if (hair) box = window;
    vec2 moved = imageLoad(velocity, clamp(pixel + nearest.offset, ivec2(0), size - 1)).xy;
    vec2 uv = (vec2(pixel) + 0.5 - moved) * inverse_size;
    float share = history_valid != 0u ? taa_blend(uv, blend) : 1.0;
    bool still = moved == vec2(0.0);
    float memory = kNearHair ? taa_memory(nearest.front == kHair, still, 0.0) : 0.0;
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

void main() {
    ivec2 pixel = first + ivec2(gl_GlobalInvocationID.xy) * ivec2(1, kRows);
    if (any(greaterThanEqual(pixel, end))) return;
    int last = min(pixel.y + kRows, end.y);
    Row highest = load_row(pixel - ivec2(0, kNearHair ? 2 : 1));  // without hair nobody looks at it
    Row above = kNearHair ? load_row(pixel - ivec2(0, 1)) : highest;
    Row here = load_row(pixel);
    Row below = kNearHair ? load_row(pixel + ivec2(0, 1)) : here;
    for (; pixel.y < last; ++pixel.y) {
        Row lowest = load_row(pixel + ivec2(0, kNearHair ? 2 : 1));
        if (!kNearHair) below = lowest;
        TaaBox box = around(here.box, around(above.box, below.box));
        TaaBox window = around(around(highest.window, lowest.window),
                               around(here.window, around(above.window, below.window)));
        bool hair = highest.hair || above.hair || here.hair || below.hair || lowest.hair;
        resolve(pixel, here.centre, nearest_of(above, here, below), box, window, hair);
        highest = above;
        above = here;
        here = below;
        below = lowest;
    }
}
