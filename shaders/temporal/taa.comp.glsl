#version 460
#extension GL_GOOGLE_include_directive : require
#include "temporal/taa.glsl"

// One pixel of the new history from this frame's picture and last frame's history.
const int kTileX = 16, kTileY = 8;
layout(local_size_x = 16, local_size_y = 8) in;
layout(push_constant) uniform Push {
    ivec2 size;
    vec2 inverse_size;
    float blend;
    uint history_valid;
};
layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D velocity;
layout(binding = 2) uniform sampler2D history;
layout(binding = 3, rgba16f) uniform writeonly image2D result;

// The tile's pixels with a border of one, in YCoCg; a texel is fetched once for all neighbours.
shared vec3 tile[(kTileX + 2) * (kTileY + 2)];

void load_tile() {
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(kTileX, kTileY) - 1;
    for (uint i = gl_LocalInvocationIndex; i < tile.length(); i += kTileX * kTileY) {
        ivec2 at = clamp(corner + ivec2(i % (kTileX + 2), i / (kTileX + 2)), ivec2(0), size - 1);
        tile[i] = taa_load(texelFetch(color, at, 0).rgb);
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
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    int at = (int(gl_LocalInvocationID.y) + 1) * (kTileX + 2) + int(gl_LocalInvocationID.x) + 1;
    vec3 current = tile[at];
    TaaBox box = taa_box_start(current);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) taa_box_add(box, tile[at + y * (kTileX + 2) + x]);
    }
    vec2 moved = texelFetch(velocity, pixel, 0).xy;
    vec2 uv = (vec2(pixel) + 0.5 - moved) * inverse_size;
    float share = history_valid != 0u ? taa_blend(uv, blend) : 1.0;
    vec3 before = share < 1.0 ? taa_clamp(box, rgb_to_ycocg(read_history(uv, moved))) : current;
    imageStore(result, pixel, vec4(taa_resolve(current, before, share), 1.0));
}
