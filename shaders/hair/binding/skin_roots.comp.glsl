#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/binding/bound_roots.glsl"
#include "hair/binding/root_frame.glsl"

// Morphs and skins the vertices that carry roots, this frame and the last (glTF 2.0, 3.7.2.2 and 3.7.3).
// Each is done once, however many strands grow around it.
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    BoundVertices vertices;
    BoundMorphs morphs;  // target by target
    Affines palette;     // mesh to metres from the anchor
    Affines previous_palette;
    MorphWeights weights;
    MorphWeights previous_weights;
    MovedVertices moved;
    uint vertex_count;
    uint target_count;
};

mat4x3 blend(Affines from, BoundVertex v) {
    return from.at[v.joints.x & 0xffffu] * v.weights.x + from.at[v.joints.x >> 16] * v.weights.y +
           from.at[v.joints.y & 0xffffu] * v.weights.z + from.at[v.joints.y >> 16] * v.weights.w;
}

void main() {
    uint i = thread_index();
    if (i >= vertex_count) return;
    BoundVertex v = vertices.at[i];
    vec3 position = v.position, previous = v.position;
    vec3 normal = v.normal, previous_normal = v.normal;
    for (uint t = 0u; t < target_count; ++t) {
        float weight = weights.at[t], previous_weight = previous_weights.at[t];
        if (weight == 0.0 && previous_weight == 0.0) continue;
        BoundMorph delta = morphs.at[t * vertex_count + i];
        position += weight * delta.position;
        normal += weight * delta.normal;
        previous += previous_weight * delta.position;
        previous_normal += previous_weight * delta.normal;
    }
    mat4x3 now = blend(palette, v);
    mat4x3 before = blend(previous_palette, v);
    moved.at[i] = MovedVertex(now * vec4(position, 1.0), map_normal(now, normal),
                              before * vec4(previous, 1.0), map_normal(before, previous_normal));
}
