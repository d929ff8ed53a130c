// Columns of a groom on the device, by address. GLSL only.
#ifndef VELLUS_HAIR_STRANDS_GLSL
#define VELLUS_HAIR_STRANDS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(buffer_reference, scalar) readonly buffer Vec3s { vec3 at[]; };
layout(buffer_reference, scalar) readonly buffer Floats { float at[]; };
layout(buffer_reference, scalar) readonly buffer Uints { uint at[]; };
layout(buffer_reference, scalar) readonly buffer Uvec2s { uvec2 at[]; };
layout(buffer_reference, scalar) buffer Words { uint at[]; };
layout(buffer_reference, scalar) buffer LongWords { uint64_t at[]; };

// A point on the screen: pixels x and y, depth, width in pixels; a negative width means behind the
// near plane.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer ProjectedPoints { vec4 at[]; };

// Arc length over strand length of point i, 0 at the root to 1 at the tip.
float point_parameter(Uints parameters, uint i) {
    uint pair = parameters.at[i >> 1];
    return float((i & 1u) == 0u ? pair & 0xffffu : pair >> 16) * (1.0 / 65535.0);
}

#endif
