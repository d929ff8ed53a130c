#version 460
#extension GL_GOOGLE_include_directive : require
#include "character/mesh_data.glsl"
#include "common/thread.glsl"
#include "hair/environment/cover.glsl"

// Morphs and skins one primitive, this frame and the last, so that later stages only project. glTF 2.0,
// sections 3.7.2.2 and 3.7.3; the plain counterpart is modules/character/reference/skin.h.
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCovered = false;  // something keeps the sky from this primitive
layout(push_constant, scalar) uniform Push {
    RestVertices rest;
    MorphDeltas morphs;  // target by target
    MorphWeights weights;
    MorphWeights previous_weights;
    Affines palette;  // mesh space to camera-relative world
    Affines previous_palette;
    SkinnedVertices skinned;
    uint vertex_count;
    uint target_count;
    uint has_joints;  // 0: entry 0 of the palette moves all
    float cover_thickness;
    CoveredVertices cover;
    SkinnedCovers skinned_cover;
    vec3 cover_forward;
    vec3 cover_backward;
};

mat4x3 blend(Affines from, RestVertex v) {
    if (has_joints == 0) return from.at[0];
    return from.at[v.joints.x & 0xffffu] * v.weights.x + from.at[v.joints.x >> 16] * v.weights.y +
           from.at[v.joints.y & 0xffffu] * v.weights.z + from.at[v.joints.y >> 16] * v.weights.w;
}

// Inverse transpose up to a positive factor: the cofactors, and the sign of the determinant.
vec3 transform_normal(mat4x3 m, vec3 n) {
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    vec3 turned = cofactors * n;
    float squared = dot(turned, turned);
    if (!(squared > 0.0)) return vec3(0.0, 0.0, 1.0);
    return turned * (inversesqrt(squared) * (dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0));
}

/// As the matrix turns it, as long as before.
vec3 turned(mat4x3 m, vec3 v) {
    vec3 moved = mat3(m) * v;
    float squared = dot(moved, moved);
    return squared > 0.0 ? moved * sqrt(dot(v, v) / squared) : vec3(0.0);
}

void main() {
    uint i = thread_index();
    if (i >= vertex_count) return;
    RestVertex v = rest.at[i];
    vec3 position = v.position;
    vec3 previous = v.position;
    vec3 normal = v.normal;
    for (uint t = 0; t < target_count; ++t) {
        float weight = weights.at[t];
        float previous_weight = previous_weights.at[t];
        if (weight == 0.0 && previous_weight == 0.0) continue;
        MorphDelta delta = morphs.at[t * vertex_count + i];
        position += weight * delta.position;
        previous += previous_weight * delta.position;
        normal += weight * delta.normal;
    }
    mat4x3 matrix = blend(palette, v);
    skinned.at[i].position = matrix * vec4(position, 1.0);
    skinned.at[i].normal = transform_normal(matrix, normal);
    if (kCovered) {
        CoveredVertex covered = cover.at[i];
        vec4 lean_and_open = unpackSnorm4x8(covered.lean_and_open);
        skinned_cover.at[i].share = cover_share(lean_and_open.w, cover_thickness * covered.depth,
                                                cover_forward, cover_backward);
        skinned_cover.at[i].lean = turned(matrix, 2.0 * lean_and_open.xyz);
    }
    skinned.at[i].previous = blend(previous_palette, v) * vec4(previous, 1.0);
}
