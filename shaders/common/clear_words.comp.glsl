#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

// Sets `count` 32-bit words to `value`.
layout(local_size_x = 256) in;
layout(buffer_reference, scalar) buffer Words { uint word[]; };
layout(push_constant, scalar) uniform Push { Words words; uint count; uint value; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < count) words.word[i] = value;
}
