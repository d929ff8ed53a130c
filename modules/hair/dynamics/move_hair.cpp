#include "modules/hair/dynamics/move_hair.h"

#include <algorithm>
#include <cmath>

namespace vellus::hair {

namespace {

/// Greater of width and height of a box in the picture, pixels; all of it where the box reaches
/// behind the camera.
float pixels_across(const scene::Box& box, const scene::ViewState& view) {
    glm::vec2 low(1.0f);
    glm::vec2 high(-1.0f);
    for (const glm::dvec3& corner : box.corners()) {
        const glm::vec4 clip = view.view.view_projection * glm::vec4(view.relative(corner), 1.0f);
        if (clip.w <= view.view.near_plane) return static_cast<float>(view.view.size.y);
        low = glm::min(low, glm::vec2(clip) / clip.w);
        high = glm::max(high, glm::vec2(clip) / clip.w);
    }
    const glm::vec2 across = 0.5f * (high - low) * glm::vec2(view.view.size);
    return std::max(across.x, across.y);
}

MotionReason decide(const HairMotion& motion, const scene::Box& box, const scene::ViewState& view) {
    if (!motion.enabled) return MotionReason::kSwitchedOff;
    if (box.empty() || !in_view(box, view)) return MotionReason::kOutOfView;
    if (pixels_across(box, view) < motion.smallest_pixels) return MotionReason::kTooSmall;
    return MotionReason::kChosen;
}

/// Capsules whose surface strands may reach, in the order of their entities.
void gather_capsules(const ColliderQuery& colliders, const scene::Box& box,
                     std::vector<WorldCapsule>& out) {
    out.clear();
    const double reach = 0.5 * glm::length(box.max - box.min);
    colliders.each(
        [&](Entity entity, const HairCollider& collider, const scene::WorldTransform& world) {
            const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(world.matrix))));
            const glm::dvec3 a(world.matrix * glm::dvec4(glm::dvec3(collider.from), 1.0));
            const glm::dvec3 b(world.matrix * glm::dvec4(glm::dvec3(collider.to), 1.0));
            const double radius = scale * static_cast<double>(collider.radius);
            const glm::dvec3 middle = 0.5 * (a + b);
            const glm::dvec3 nearest = glm::clamp(middle, box.min, box.max);
            if (glm::distance(middle, nearest) > reach + radius + glm::distance(a, middle)) return;
            out.push_back({a, b, radius, uint64_t{entity.generation} << 32 | entity.index});
        });
    std::ranges::sort(out, {}, &WorldCapsule::id);
}

/// Around all strands: the guides' points, widened by how far other strands are from them.
scene::Box moved_box(const GroomMotion& groom, double scale) {
    const GuideSet& guides = groom.motion.guides();
    scene::Box box;
    for (uint32_t g = 0; g < guides.count; ++g) {
        const RootPose& root = groom.roots[g];
        visit_guide_points(guides, groom.motion.state(), g, [&](const glm::vec3& point) {
            box.include(root.place + root.turn * (scale * glm::dvec3(point)));
        });
    }
    if (box.empty()) return box;
    // Strands keep their shape beside a guide that bends; half as far again leaves room.
    const glm::dvec3 margin(1.5 * scale * static_cast<double>(groom.spread) + 0.005);
    box.min -= margin;
    box.max += margin;
    return box;
}

/// Where hair may be when only the device knows: as far from the roots as it is long.
scene::Box reach_box(const GroomMotion& groom, double scale) {
    const GuideSet& guides = groom.motion.guides();
    scene::Box box;
    double longest = 0.0;
    for (uint32_t g = 0; g < guides.count; ++g) {
        box.include(groom.roots[g].place);
        longest = std::max(longest, static_cast<double>(guides.length[g]));
    }
    const glm::dvec3 margin(scale * (longest + static_cast<double>(groom.spread)) + 0.005);
    box.min -= margin;
    box.max += margin;
    return box;
}

/// One frame on the processor.
void solve_here(const HairMotion& motion, const MotionFrame& frame, bool resumed,
                GroomMotion& groom) {
    const bool slept = groom.motion.asleep();
    groom.device.reset();
    groom.motion.advance(motion.settings, frame);
    groom.previous_slot = groom.slot;
    if (slept && groom.motion.asleep() && !resumed) return;
    write_turns(groom);
    groom.box = moved_box(groom, frame.scale);
}

/// One frame on the device: what it is to do, for describe_hair_motion.
void solve_there(const HairMotion& motion, const MotionFrame& frame, bool resumed,
                 GroomMotion& groom) {
    const bool slept = groom.motion.asleep();
    groom.motion.prepare(motion.settings, frame);
    if (!groom.motion.asleep()) groom.motion.solved_elsewhere();
    groom.previous_slot = groom.slot;
    if (slept && groom.motion.asleep() && !resumed) return;
    groom.slot = (groom.slot + 1) % kTurnSlots;
    groom.solve = true;
    groom.bent = true;
    groom.box = reach_box(groom, frame.scale);
}

void stop(GroomMotion& groom, HairMoves& moves) {
    moves.now = false;
    groom.last_frame.reset();
}

}  // namespace

void move_hair(MotionQuery hair, ColliderQuery colliders, Res<const HairBindings> bindings,
               Res<const HairPoses> poses, Res<const scene::ViewState> view,
               Res<const scene::FixedStep> step, Res<const Wind> wind, Res<HairMotions> motions) {
    hair.each([&](Entity, const Hair&, HairMotion& motion, HairMoves& moves,
                  const scene::WorldTransform& world, const scene::PreviousWorldTransform& before,
                  scene::WorldBounds& bounds, const HairBinding* binding) {
        GroomMotion& groom = *motions->list[motion.slot];
        if (groom.last_frame) bounds.box.include(groom.box);
        motion.reason = decide(motion, bounds.box, *view);
        if (motion.reason != MotionReason::kChosen) return stop(groom, moves);
        const bool carried = binding != nullptr && binding->pose != kNoPose;
        const BoundRoots* const bound = carried ? &bindings->list[binding->roots].roots : nullptr;
        double scale = 1.0;
        if (!place_roots(bound, carried ? &poses->list[binding->pose] : nullptr, world.matrix,
                         groom, scale)) {
            motion.reason = MotionReason::kMirrored;
            return stop(groom, moves);
        }
        gather_capsules(colliders, bounds.box, groom.capsules);
        const bool resumed = !groom.last_frame || *groom.last_frame > step->frame;
        const uint64_t frames = resumed ? 0 : step->frame - *groom.last_frame;
        groom.last_frame = step->frame;
        const MotionFrame frame{.dt = step->dt * static_cast<double>(frames),
                                .time = step->time(),
                                .scale = scale,
                                .teleported = resumed || !before.known,
                                .roots = groom.roots,
                                .capsules = groom.capsules,
                                .wind = *wind};
        groom.solve = false;
        if (motion.solver == MotionSolver::kProcessor) {
            solve_here(motion, frame, resumed, groom);
        } else {
            solve_there(motion, frame, resumed, groom);
        }
        if (groom.motion.asleep()) motion.reason = MotionReason::kAsleep;
        moves.now = groom.bent;
        if (groom.bent) bounds.box.include(groom.box);
    });
}

}  // namespace vellus::hair
