// A groom bound to a mesh, by address; mirrored by modules/hair/binding/bound_roots.h, where the fields
// are explained. GLSL only.
#ifndef VELLUS_HAIR_BOUND_ROOTS_GLSL
#define VELLUS_HAIR_BOUND_ROOTS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

struct BoundVertex {
    vec3 position;
    vec3 normal;
    uvec2 joints;  // four of 16 bit
    vec4 weights;
};

struct BoundMorph {
    vec3 position;
    vec3 normal;
};

struct BoundRoot {
    uvec3 vertices;
    vec2 barycentric;
    vec4 rest_inverse;
    uint first_point;
    uint point_count;
    uint flat_normal;
};

/// A bound vertex as this frame and the last have it, in metres from the groom's anchor.
struct MovedVertex {
    vec3 position;
    vec3 normal;  // any length
    vec3 previous_position;
    vec3 previous_normal;
};

layout(buffer_reference, scalar) readonly buffer BoundVertices { BoundVertex at[]; };
layout(buffer_reference, scalar) readonly buffer BoundMorphs { BoundMorph at[]; };
layout(buffer_reference, scalar) readonly buffer BoundRoots { BoundRoot at[]; };
layout(buffer_reference, scalar) readonly buffer Affines { mat4x3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MorphWeights { float at[]; };
layout(buffer_reference, scalar) buffer MovedVertices { MovedVertex at[]; };

#endif
