#version 460
#extension GL_GOOGLE_include_directive : require
#include "hair/geometry/strands.glsl"
#include "hair/shadow/deep_opacity.glsl"

// Starts the layers of a light's deep opacity map: each texel's front is the closest hair of the 2x2
// texels of the shadow map over it, its layers are empty.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push {
    Words depth;
    Words layers;
    int size;  // texels along a side of the layers; the shadow map has twice as many
};

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(size)))) return;
    uint row = uint(2 * texel.y * 2 * size + 2 * texel.x);
    uint below = row + uint(2 * size);
    uint word = uint(texel.y * size + texel.x) * kDeepWords;
    layers.at[word] = max(max(depth.at[row], depth.at[row + 1u]), max(depth.at[below], depth.at[below + 1u]));
    for (uint i = 1u; i < kDeepWords; ++i) layers.at[word + i] = 0u;
}
