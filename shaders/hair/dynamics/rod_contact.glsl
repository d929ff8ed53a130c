// Points of a strand against capsules.
#if !defined(VELLUS_ROD_CONTACT_GLSL) || defined(__cplusplus)
#define VELLUS_ROD_CONTACT_GLSL

struct RodContact {
    rvec3 normal;     // out of the capsule
    real distance;    // to its surface, negative inside
    rvec3 travel;     // of the capsule there, over the substep
};

/// A capsule where it is at two moments.
struct RodCapsuleStep {
    rvec3 a;
    rvec3 b;
    rvec3 a_travel;
    rvec3 b_travel;
    real radius;
};

VELLUS_FN RodContact rod_contact(RodCapsuleStep capsule, rvec3 point) {
    rvec3 axis = capsule.b - capsule.a;
    rvec3 from = point - capsule.a;
    real along = rod_dot(from, axis) / max(rod_dot(axis, axis), real(1.0e-12f));
    along = min(max(along, real(0.0f)), real(1.0f));
    rvec3 out_of = from - axis * along;
    real away = rod_length(out_of);
    RodContact contact;
    rmask apart = away > real(1.0e-7f);
    contact.normal = rod_choose(apart, out_of * (real(1.0f) / max(away, real(1.0e-7f))),
                                rvec3(real(0.0f), real(1.0f), real(0.0f)));
    contact.distance = away - capsule.radius;
    contact.travel = capsule.a_travel + (capsule.b_travel - capsule.a_travel) * along;
    return contact;
}

/// How deep a point `along` metres from the root may lie inside, where the root itself lies
/// `root_depth` inside: the scalp may be under a collider's surface, and hair leaves it gradually.
VELLUS_FN real rod_allowed_depth(real root_depth, real along) {
    real reach = real(4.0f) * root_depth + real(0.01f);
    return root_depth * max(real(1.0f) - along / reach, real(0.0f));
}

#endif
