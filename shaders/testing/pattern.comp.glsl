#version 460
#extension GL_EXT_scalar_block_layout : require

// Numbers that differ from pixel to pixel and frame to frame, and that half floats hold exactly.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba16f) uniform writeonly image2D result;
layout(push_constant, scalar) uniform Push { uint frame; };

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    uvec3 bits = uvec3(p, frame) * uvec3(73u, 151u, 29u);
    vec3 value = vec3((bits.x + bits.y * 7u + bits.z) % 256u, (bits.x ^ bits.y) % 256u, bits.z % 256u);
    if (all(lessThan(p, imageSize(result)))) imageStore(result, p, vec4(value / 256.0, 1.0));
}
