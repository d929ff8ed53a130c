// How a strand follows its guides: each segment turns by the blend of its guides' turns at the same place
// along them, so that lengths stay what they were and curls keep their shape. The includer gives access:
//   vec4 guide_turn(uint guide, uint link)   quaternion x y z w from where the root carries a link to
//                                            where it is
#if !defined(VELLUS_HAIR_TRANSFER_GLSL) || defined(__cplusplus)
#define VELLUS_HAIR_TRANSFER_GLSL

VELLUS_FN vec4 same_side(vec4 q, vec4 as) { return dot(q, as) < 0.0f ? -q : q; }

/// Turn of a guide at the share `along` of its length: links hold theirs at their middle, the root none.
VELLUS_FN vec4 turn_along(uint guide, float along, uint links) {
    float at = along * float(links) - 0.5f;
    float low = floor(at);
    uint first = uint(clamp(low, 0.0f, float(links - 1u)));
    uint second = min(uint(max(low + 1.0f, 0.0f)), links - 1u);
    vec4 b = guide_turn(guide, second);
    vec4 a = at < 0.0f ? vec4(0.0f, 0.0f, 0.0f, 1.0f) : guide_turn(guide, first);
    // From the root to the middle of the first link is half a step.
    float t = at < 0.0f ? 1.0f + 2.0f * max(at, -0.5f) : at - low;
    return mix(a, same_side(b, a), t);
}

/// Turn of a strand's segment whose middle is at the share `along` of the strand; a unit quaternion.
VELLUS_FN vec4 strand_turn(uvec3 guides, vec3 weights, vec3 reach, float along, uint links) {
    vec4 first = turn_along(guides.x, along * reach.x, links);
    vec4 sum = first * weights.x;
    if (weights.y > 0.0f) {
        sum += same_side(turn_along(guides.y, along * reach.y, links), first) * weights.y;
    }
    if (weights.z > 0.0f) {
        sum += same_side(turn_along(guides.z, along * reach.z, links), first) * weights.z;
    }
    float size = dot(sum, sum);
    return size > 1.0e-12f ? sum * inversesqrt(size) : vec4(0.0f, 0.0f, 0.0f, 1.0f);
}

VELLUS_FN vec3 turn_vector(vec4 q, vec3 v) {
    vec3 u = vec3(q.x, q.y, q.z);
    vec3 t = cross(u, v) * 2.0f;
    return v + t * q.w + cross(u, t);
}

#endif
