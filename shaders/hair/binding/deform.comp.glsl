#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/thread.glsl"
#include "hair/binding/bound_roots.glsl"
#include "hair/binding/root_frame.glsl"
#include "hair/geometry/strands.glsl"

// Carries each strand with the triangle below its root, this frame and the last. One thread a strand: its
// two frames are worked out once.
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) writeonly buffer Points { vec3 at[]; };
layout(push_constant, scalar) uniform Push {
    BoundRoots roots;
    MovedVertices moved;
    Vec3s local;
    Points points;  // metres from the groom's anchor
    Points previous_points;
    uint strand_count;
    float scale;  // metres per metre of the groom
    float previous_scale;
    float handedness;
};

void main() {
    uint strand = thread_index();
    if (strand >= strand_count) return;
    BoundRoot root = roots.at[strand];
    MovedVertex a = moved.at[root.vertices.x];
    MovedVertex b = moved.at[root.vertices.y];
    MovedVertex c = moved.at[root.vertices.z];
    vec2 at = root.barycentric;
    float first = 1.0 - at.x - at.y;
    float smooth_share = root.flat_normal != 0u ? 0.0 : 1.0;

    vec3 e1 = b.position - a.position, e2 = c.position - a.position;
    vec3 normal = (a.normal * first + b.normal * at.x + c.normal * at.y) * smooth_share;
    mat3 axes = root_axes(e1, e2, normal, root.rest_inverse, handedness) * scale;
    vec3 origin = a.position + e1 * at.x + e2 * at.y;

    e1 = b.previous_position - a.previous_position;
    e2 = c.previous_position - a.previous_position;
    normal = (a.previous_normal * first + b.previous_normal * at.x + c.previous_normal * at.y) *
             smooth_share;
    mat3 previous_axes = root_axes(e1, e2, normal, root.rest_inverse, handedness) * previous_scale;
    vec3 previous_origin = a.previous_position + e1 * at.x + e2 * at.y;

    for (uint i = root.first_point; i < root.first_point + root.point_count; ++i) {
        vec3 p = local.at[i];
        points.at[i] = origin + axes * p;
        previous_points.at[i] = previous_origin + previous_axes * p;
    }
}
