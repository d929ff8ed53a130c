// The frame a strand's root stands in: from the skinned triangle below it. The CPU evaluates the same
// functions for guides and bounds (modules/hair/binding/root_frame.h).
#ifndef VELLUS_HAIR_ROOT_FRAME_GLSL
#define VELLUS_HAIR_ROOT_FRAME_GLSL
#include "common/portable.glsl"

/// A unit vector across the unit vector n, without branch but for the sign (Duff et al. 2017, JCGT 6(1)).
VELLUS_FN vec3 any_across(vec3 n) {
    float s = n.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (s + n.z);
    return vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

/// v at unit length; `otherwise` where v has no direction.
VELLUS_FN vec3 unit_or(vec3 v, vec3 otherwise) {
    float squared = dot(v, v);
    return squared > 1.0e-36f && is_finite(squared) ? v * inversesqrt(squared) : otherwise;
}

/// Direction of a surface normal after the affine map m: by the cofactors, with the determinant's sign, so
/// that it stays on its side of the surface. Not unit; zero where m is singular.
VELLUS_FN vec3 map_normal(mat4x3 m, vec3 n) {
    vec3 x = cross(m[1], m[2]);
    vec3 turned = x * n.x + cross(m[2], m[0]) * n.y + cross(m[0], m[1]) * n.z;
    return dot(m[0], x) < 0.0f ? -turned : turned;
}

/// Axes (tangent, normal, bitangent) of the root frame, orthonormal whatever the triangle, and a rotation
/// (right-handed) where the mesh is not mirrored. `e1`, `e2`: its
/// edges from the first vertex; `normal`: wanted direction, any length; `handedness`: -1 where the mesh is
/// mirrored against its rest. The turn about the normal is the rotation nearest to the triangle's in-plane
/// deformation (polar decomposition in 2D), so that it depends on no choice of edge and shear turns all
/// triangles alike; a triangle fallen into a line keeps that line's turn. `rest_inverse`: inverse of the
/// rest edges' coordinates in the plane, see root_rest_inverse.
VELLUS_FN mat3 root_axes(vec3 e1, vec3 e2, vec3 normal, vec4 rest_inverse, float handedness) {
    vec3 flat_normal = unit_or(cross(e1, e2) * handedness, vec3(0.0f, 1.0f, 0.0f));
    vec3 n = unit_or(normal, flat_normal);
    vec3 x = any_across(n);
    vec3 y = cross(n, x) * handedness;
    vec2 edge1 = vec2(dot(e1, x), dot(e1, y));
    vec2 edge2 = vec2(dot(e2, x), dot(e2, y));
    vec2 column0 = edge1 * rest_inverse.x + edge2 * rest_inverse.y;
    vec2 column1 = edge1 * rest_inverse.z + edge2 * rest_inverse.w;
    vec2 turn = vec2(column0.x + column1.y, column0.y - column1.x);
    float squared = dot(turn, turn);
    turn = squared > 1.0e-18f && is_finite(squared) ? turn * inversesqrt(squared) : vec2(1.0f, 0.0f);
    vec3 t = x * turn.x + y * turn.y;
    return mat3(t, n, cross(t, n) * handedness);
}

#endif
