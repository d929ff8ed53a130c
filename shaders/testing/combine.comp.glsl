#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

// result = (shifted first + second) / 2 + word / 1024, second only where `use_second`.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D first;
layout(binding = 1) uniform sampler2D second;
layout(binding = 2, rgba16f) uniform writeonly image2D result;
layout(buffer_reference, scalar) readonly buffer Words { uint word[]; };
layout(push_constant, scalar) uniform Push { Words words; uint use_words; uint use_second; };

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(p, size))) return;
    vec2 at = (vec2(p) + 0.5) / vec2(size);
    vec4 value = 0.5 * textureLod(first, at + 2.0 / vec2(size), 0.0);
    if (use_second != 0u) value += 0.5 * textureLod(second, at, 0.0);
    if (use_words != 0u) value += float(words.word[uint(p.x) % use_words]) / 1024.0;
    imageStore(result, p, value);
}
