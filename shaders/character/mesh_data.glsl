// Columns of meshes on the device, by address; mirrored by modules/character/mesh_data.h. GLSL only.
#ifndef VELLUS_MESH_DATA_GLSL
#define VELLUS_MESH_DATA_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

struct RestVertex {
    vec3 position;
    vec3 normal;
    uvec2 joints;  // four of 16 bit
    vec4 weights;  // sum to 1
};

struct MorphDelta {
    vec3 position;
    vec3 normal;
};

struct SkinnedVertex {
    vec3 position;  // relative to the camera
    vec3 normal;    // unit
    vec3 previous;  // last frame's position, relative to the camera of *this* frame
};

struct CoveredVertex {
    uint lean_and_open;
    float depth;
};

struct SkinnedCover {
    vec3 share;  // of the sky's light that arrives
    vec3 lean;   // added to the normal: where from
};

layout(buffer_reference, scalar) readonly buffer RestVertices { RestVertex at[]; };
layout(buffer_reference, scalar) readonly buffer MorphDeltas { MorphDelta at[]; };
layout(buffer_reference, scalar) readonly buffer Affines { mat4x3 at[]; };
layout(buffer_reference, scalar) readonly buffer MorphWeights { float at[]; };
layout(buffer_reference, scalar) buffer SkinnedVertices { SkinnedVertex at[]; };
layout(buffer_reference, scalar) readonly buffer CoveredVertices { CoveredVertex at[]; };
layout(buffer_reference, scalar) buffer SkinnedCovers { SkinnedCover at[]; };

#endif
