// One frame of one guide. The includer gives it access to the guide's columns:
//   rvec3 rod_rest(int i)        link i of the groom as loaded, root end to tip end, metres
//   rvec3 rod_preload(int i)     moment of joint i that carries the groom's own weight
//   rvec4 rod_rotation(int i)    link i from the groom as loaded, in the root's frame; and its store
//   rvec3 rod_velocity(int i)    of the tip end of link i, turned into the root's frame; and store
//   real  rod_tension(int i)     force along link i; and store
//   RodCapsuleStep rod_capsule(int c, float begin, float end)
//   RodParams rod_params; int rod_links; rvec4 rod_turn, rod_spin; rvec3 rod_place0, rod_place1
//   and room to work: rvec3 rod_olds[], rod_offsets[], rod_spins[], rod_forces[]; RodGain
//   rod_gains[]; uint rod_near.

/// Link i as groomed, in metres of the world.
VELLUS_FN rvec3 rod_sized(int i) { return rod_rest(i) * real(rod_params.scale); }

/// Speed of the air at a point: the mean wind with gusts that travel through space.
VELLUS_FN real rod_wave(real turns) {
    real t = (turns - floor(turns)) * real(2.0f) - real(1.0f);
    return t * (real(1.0f) - abs(t)) * real(4.0f);  // within 6 % of a sine
}

VELLUS_FN rvec3 rod_air(rvec3 point, real substep) {
    rvec3 phase = rod_spread(rod_params.gust_phase) + rod_spread(rod_params.gust_rate) * substep;
    real a = rod_wave(phase.x + point.x * real(0.31f) + point.z * real(0.17f));
    real b = rod_wave(phase.y - point.z * real(0.83f) + point.y * real(0.41f));
    real c = rod_wave(phase.z + point.x * real(2.3f) - point.y * real(1.7f));
    rvec3 wind = rod_spread(rod_params.wind);
    real speed = rod_length(wind) * real(rod_params.gust);
    real swell = real(1.0f) + real(rod_params.gust) * (real(0.6f) * a + real(0.4f) * b);
    return wind * swell +
           rvec3(real(0.25f) * b, real(0.15f) * c, real(0.25f) * c) * speed;
}

/// Weight and target of a point that would go to e, contacts included.
VELLUS_FN void rod_point(rvec3 point, rvec3 e, real w, real depth, float begin, float end,
                         rvec3 root_travel, VELLUS_INOUT(RodSymmetric) weight,
                         VELLUS_INOUT(rvec3) target) {
    for (int c = 0; c < int(rod_params.capsules); ++c) {
        if ((rod_near & (1u << uint(c))) == 0u) continue;
        RodCapsuleStep capsule = rod_capsule(c, begin, end);
        RodContact contact = rod_contact(capsule, point + e);
        real distance = contact.distance + depth;
        rmask touches = distance < real(0.0f);
        if (!any_lane(touches)) continue;
        // Stiff along the normal, friction across: both implicit, so no step is too long for them.
        real hard = choose(touches, w * real(50.0f), real(0.0f));
        real rub = choose(touches, w * real(rod_params.friction * rod_params.step), real(0.0f));
        rvec3 n = contact.normal;
        weight = rod_add(weight, rod_symmetric(rub, hard - rub, n));
        rvec3 slide = contact.travel - root_travel;
        rvec3 across = slide - n * rod_dot(slide, n);
        target = target + n * (hard * (rod_dot(n, e) - distance)) + across * rub;
    }
}

/// A link from `base` that ends outside all capsules, as near to `offset` as may be.
VELLUS_FN rvec3 rod_push_out(rvec3 base, rvec3 offset, real size, real depth, float end) {
    for (int pass = 0; pass < 4; ++pass) {
        rvec3 tip = base + offset;
        real deepest = real(0.0f);
        for (int c = 0; c < int(rod_params.capsules); ++c) {
            if ((rod_near & (1u << uint(c))) == 0u) continue;
            RodContact contact = rod_contact(rod_capsule(c, end, end), tip);
            real inside = min(contact.distance + depth, real(0.0f));
            tip = tip - contact.normal * inside;
            deepest = min(deepest, inside);
        }
        if (!any_lane(deepest < real(0.0f))) break;
        rvec3 pushed = tip - base;
        offset = rod_choose(deepest < real(0.0f),
                            pushed * (size / max(rod_length(pushed), real(1.0e-9f))), offset);
    }
    return offset;
}

/// Finds the capsules within reach of the strand this frame, and how deep the root lies in them.
VELLUS_FN real rod_find_near(real reach) {
    rod_near = 0u;
    real depth = real(0.0f);
    real margin = reach + rod_length(rod_place1 - rod_place0) + real(0.01f);
    for (int c = 0; c < int(rod_params.capsules); ++c) {
        RodContact now = rod_contact(rod_capsule(c, 0.0f, 0.0f), rod_place0);
        RodContact last = rod_contact(rod_capsule(c, 0.0f, 1.0f), rod_place1);
        real distance = min(now.distance, last.distance);
        if (any_lane(distance < margin + rod_length(last.travel))) rod_near |= 1u << uint(c);
        depth = max(depth, -distance);
    }
    return depth;
}

/// Bend, twist and hold of link i, `turn` and the one before it, `before`, being where they are.
VELLUS_FN RodLink rod_link(int i, rvec4 before, rvec4 turn, rvec4 root, rvec3 root_turn,
                           rvec3 spin_before, rvec3 spin, rvec3 offset, real size, real size_before, real total) {
    RodLink link;
    link.offset = offset;
    real inverse_size = real(1.0f) / max(size, real(1.0e-6f));
    rvec3 direction = offset * inverse_size;
    real stiffness = real(rod_params.stiffness) /
                     max((size + size_before) * real(0.5f), real(1.0e-4f));
    real twist = stiffness * real(rod_params.twist - 1.0f);
    real viscous = real(rod_params.damping / rod_params.step);
    real bend_step = stiffness * (real(1.0f) + viscous);
    link.joint = rod_symmetric(bend_step, twist * (real(1.0f) + viscous), direction);
    rvec3 phi = rod_rotation_vector(rod_multiply(turn, rod_conjugate(before)));
    // Dampers resist the turn since the step began, of which the prediction is a part.
    rvec3 slip = phi + (spin - spin_before) * viscous;
    link.joint_moment = slip * stiffness + direction * (twist * rod_dot(direction, slip)) +
                        rod_rotate(before, rod_preload(i)) *
                            real(rod_params.scale * rod_params.scale);

    real hold = real(rod_params.hold * 9.81f) * total * size;
    rvec3 psi = rod_rotation_vector(rod_multiply(turn, rod_conjugate(root)));
    link.own_moment = (psi + (spin - root_turn) * viscous) * hold;
    real taut = max(rod_tension(i), real(0.0f)) * size;
    link.own = rod_symmetric(hold * (real(1.0f) + viscous) + taut, -taut, direction);
    return link;
}

/// From share `begin` to share `end` of the frame.
VELLUS_FN void rod_substep(float substep, float begin, float end, real total, real root_depth) {
    rvec4 root = rod_normalize(rod_multiply(rod_spin, rod_turn));
    rod_turn = root;
    rvec3 root_turn = rod_rotation_vector(rod_spin);
    rvec3 travel = (rod_place1 - rod_place0) * real(end - begin);
    rvec3 jolt = travel * real(rod_params.inertia);
    rvec3 place = rod_place0 + (rod_place1 - rod_place0) * real(end);
    real h = real(rod_params.step);
    real air = real(1.0f) / (real(1.0f) + h * real(rod_params.drag));

    // Where the points are, from the root, and where links go if they spin on: near the answer what
    // the solver leaves out, the change of directions with the turn, is no more than tension.
    rvec3 zero = rvec3(real(0.0f), real(0.0f), real(0.0f));
    rvec3 old = zero;
    rvec3 point = zero;
    rvec3 velocity = jolt * (real(1.0f) / h);
    for (int i = 0; i < rod_links; ++i) {
        rvec3 rest = rod_sized(i);
        rvec3 offset = rod_rotate(rod_rotation(i), rest);
        rvec3 next_velocity = rod_velocity(i);
        real scale = h / max(rod_dot(offset, offset), real(1.0e-10f));
        rod_spins[i] = rod_limit(rod_cross(offset, next_velocity - velocity) * scale, real(0.7f));
        rvec4 rotation = rod_normalize(rod_multiply(rod_cayley(rod_spins[i]), rod_rotation(i)));
        rod_set_rotation(i, rotation);
        rod_olds[i] = offset;
        rod_offsets[i] = rod_rotate(rotation, rest);
        old = old + offset;
        point = point + rod_offsets[i];
        velocity = next_velocity;
    }

    // Tip to root: what each link should do, as a function of what the ones before it do.
    RodValue value = rod_no_value();
    real size = rod_length(rod_sized(rod_links - 1));
    real size_after = real(0.0f);
    real along = total;
    for (int i = rod_links - 1; i >= 0; --i) {
        real size_before = i > 0 ? rod_length(rod_sized(i - 1)) : real(0.0f);
        real mass = (size + size_after) * real(0.5f);
        rvec3 accelerate = rod_spread(rod_params.gravity) +
                           rod_air(place + point, real(substep)) * real(rod_params.drag);
        rvec3 e = old - point + (rod_velocity(i) + accelerate * h) * (h * air) - jolt;
        real w = mass / (h * h * air);
        rod_forces[i] = e * w;
        RodSymmetric weight = rod_symmetric(w, real(0.0f), e);
        rvec3 target = rod_forces[i];
        rod_point(place + point, e, w, rod_allowed_depth(root_depth, along), begin, end, travel,
                  weight, target);
        rvec4 before = i > 0 ? rod_rotation(i - 1) : root;
        rvec3 spin_before = i > 0 ? rod_spins[i - 1] : root_turn;
        RodLink link = rod_link(i, before, rod_rotation(i), root, root_turn, spin_before,
                                rod_spins[i], rod_offsets[i], size, size_before, total);
        link.weight = weight;
        link.target = target;
        rod_gains[i] = rod_backward(link, value);
        point = point - rod_offsets[i];
        old = old - rod_olds[i];
        along = along - size;
        size_after = size;
        size = size_before;
    }

    // Root to tip: turn the links. Shifts are measured after each turn, so the links beyond make
    // up for what the quadratic model missed.
    rvec3 shift = zero;
    rvec3 turned = zero;
    rvec3 base = place;
    rvec3 moved = jolt;
    along = real(0.0f);
    for (int i = 0; i < rod_links; ++i) {
        RodGain gain = rod_gains[i];
        turned = rod_mul(gain.turn, turned) - rod_mul(gain.shift, shift) - gain.constant;
        turned = rod_limit(turned, real(1.0f));
        rvec3 rest = rod_sized(i);
        size = rod_length(rest);
        size_after = i + 1 < rod_links ? rod_length(rod_sized(i + 1)) : real(0.0f);
        rvec4 rotation = rod_multiply(rod_cayley(turned), rod_rotation(i));
        rvec3 offset = rod_rotate(rotation, rest);
        along = along + size;
        rvec3 outside =
            rod_push_out(base, offset, size, rod_allowed_depth(root_depth, along), end);
        real inverse_size = real(1.0f) / max(size, real(1.0e-9f));
        rotation = rod_normalize(
            rod_multiply(rod_between(offset * inverse_size, outside * inverse_size), rotation));
        offset = rod_rotate(rotation, rest);
        rod_set_rotation(i, rotation);
        shift = shift + offset - rod_offsets[i];
        base = base + offset;
        moved = moved + offset - rod_olds[i];
        rod_set_velocity(i, rod_limit(moved * (real(1.0f) / h), real(60.0f)));
        real mass = (size + size_after) * real(0.5f);
        rod_forces[i] = rod_forces[i] - shift * (mass / (h * h * air));
        rod_offsets[i] = offset * inverse_size;
    }

    rvec3 force = zero;
    for (int i = rod_links - 1; i >= 0; --i) {
        force = force + rod_forces[i];
        rod_set_tension(i, rod_dot(force, rod_offsets[i]));
    }
}

/// All substeps of a frame. Between frames rotations and velocities are kept in the root's frame.
VELLUS_FN void rod_frame() {
    real total = real(0.0f);
    real rate = real(1.0f) / real(rod_params.step);
    rvec3 spin = rod_rotation_vector(rod_spin) * rate;
    rvec3 carried = (rod_place1 - rod_place0) *
                    (rate * real(rod_params.inertia / float(rod_params.substeps)));
    for (int i = 0; i < rod_links; ++i) {
        total = total + rod_length(rod_sized(i));
        rvec4 rotation = rod_multiply(rod_turn, rod_rotation(i));
        rod_set_rotation(i, rotation);
        carried = carried + rod_cross(spin, rod_rotate(rotation, rod_sized(i)));
        rod_set_velocity(i, rod_rotate(rod_turn, rod_velocity(i)) * real(rod_params.memory) +
                                carried * real(1.0f - rod_params.memory));
    }
    real root_depth = rod_find_near(total);
    float share = 1.0f / float(rod_params.substeps);
    for (uint step = 0u; step < rod_params.substeps; ++step) {
        rod_substep(float(step), float(step) * share, float(step + 1u) * share, total, root_depth);
    }
    rvec4 back = rod_conjugate(rod_turn);
    for (int i = 0; i < rod_links; ++i) {
        rod_set_rotation(i, rod_normalize(rod_multiply(back, rod_rotation(i))));
        rod_set_velocity(i, rod_rotate(back, rod_velocity(i)));
    }
}
