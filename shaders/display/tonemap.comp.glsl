#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/tonemap.glsl"

// Linear HDR to sRGB-encoded pixels.
layout(local_size_x = 16, local_size_y = 8) in;
layout(push_constant) uniform Push {
    ivec2 size;
    float exposure;
};
layout(binding = 0, rgba16f) uniform readonly image2D color;
layout(binding = 1, rgba8) uniform writeonly image2D display;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    vec3 linear_color = imageLoad(color, pixel).rgb;
    // Half a step of noise before rounding to 8 bits, the same in every frame: a sky shows no bands.
    float noise = unit_float(hash_uint(uint(pixel.y * size.x + pixel.x))) - 0.5;
    imageStore(display, pixel,
               vec4(display_color(linear_color, exposure) + vec3(noise / 255.0), 1.0));
}
