#include "modules/hair/dynamics/guide_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "modules/hair/dynamics/simulate.h"

namespace vellus::hair {

namespace {

constexpr size_t kMostCapsules = 32;
// A jump is no motion where it is both far and fast: no head does 60 m/s, and a car that does goes
// less than this far in a frame.
constexpr double kJump = 2.0;
constexpr double kJumpSpeed = 60.0;
// Motion beyond these is carried along unfelt: necks turn at up to some 20 rad/s.
constexpr double kFastest = 15.0;
constexpr double kFastestTurn = 25.0;
// Asleep after 1/8 s below 2 mm/s, which a swing passes through only where it has all but ended.
constexpr float kStillSpeed = 0.002f;
constexpr uint32_t kStillSteps = 30;
// Where speeds are not known: 2.5 s without anything to stir it.
constexpr uint32_t kQuietSteps = 600;
constexpr double kMoved = 1e-6;
// Before hair is first seen: two seconds, still every 1/30 s.
constexpr uint32_t kSettleSteps = 8;
constexpr int kSettleRounds = 60;

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(a) * b;
    return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

RootPose mix(const RootPose& a, const RootPose& b, double t) {
    return {glm::mix(a.place, b.place, t), glm::slerp(a.turn, b.turn, t)};
}

WorldCapsule mix(const WorldCapsule& a, const WorldCapsule& b, double t) {
    return {glm::mix(a.a, b.a, t), glm::mix(a.b, b.b, t), glm::mix(a.radius, b.radius, t), b.id};
}

bool same(const WorldCapsule& a, const WorldCapsule& b) {
    return glm::distance(a.a, b.a) < kMoved && glm::distance(a.b, b.b) < kMoved &&
           a.radius == b.radius && a.id == b.id;
}

glm::vec4 to_vec4(const glm::dquat& q) {
    return glm::vec4(q.x, q.y, q.z, q.w);
}

/// Whether any guide lies in a capsule by more than hair's own room over the scalp.
bool touches_capsules(const GuideSet& guides, const GuideState& state, const MotionFrame& frame) {
    for (uint32_t g = 0; g < guides.count; ++g) {
        const RootPose& root = frame.roots[g];
        bool inside = false;
        uint32_t links = 0;
        visit_guide_points(guides, state, g, [&](const glm::vec3& point) {
            if (inside || links++ <= guides.links / 4) return;
            const glm::dvec3 at = root.place + root.turn * (frame.scale * glm::dvec3(point));
            inside = std::ranges::any_of(frame.capsules, [&](const WorldCapsule& c) {
                const glm::dvec3 axis = c.b - c.a;
                const double along =
                    glm::dot(at - c.a, axis) / std::max(glm::dot(axis, axis), 1e-12);
                return glm::distance(at, c.a + axis * glm::clamp(along, 0.0, 1.0)) < c.radius;
            });
        });
        if (inside) return true;
    }
    return false;
}

double sane(double dt) {
    return std::isfinite(dt) && dt > 0.0 ? dt : 0.0;
}

}  // namespace

GuideMotion::GuideMotion(GuideSet guides)
    : guides_(std::move(guides)), state_(rest_state(guides_)) {
    work_.roots.resize(guides_.count);
}

void GuideMotion::reset() {
    state_ = rest_state(guides_);
    started_ = asleep_ = false;
    fresh_ = true;
    behind_ = 0.0;
    still_steps_ = 0;
}

bool GuideMotion::disturbed(const MotionSettings& settings, const MotionFrame& frame) const {
    if (settings != settings_ || frame.capsules.size() != capsules_.size()) return true;
    const bool windy = settings.wind > 0.0f && settings.drag > 0.0f;
    if (windy && frame.wind.velocity != glm::vec3(0.0f)) return true;
    for (size_t i = 0; i < capsules_.size(); ++i) {
        if (!same(capsules_[i], frame.capsules[i])) return true;
    }
    for (size_t i = 0; i < roots_.size(); ++i) {
        if (glm::distance(roots_[i].place, frame.roots[i].place) > kMoved) return true;
        if (angle_between(roots_[i].turn, frame.roots[i].turn) > kMoved) return true;
    }
    return false;
}

void GuideMotion::preload(const MotionFrame& frame) {
    std::vector<glm::vec3> gravity;
    gravity.reserve(guides_.count);
    for (const RootPose& root : frame.roots) {
        gravity.emplace_back(glm::conjugate(root.turn) * glm::dvec3(0.0, -9.81, 0.0));
    }
    set_preload(guides_, gravity);
    preloaded_ = true;
}

void GuideMotion::begin(const MotionFrame& frame) {
    roots_.assign(frame.roots.begin(), frame.roots.end());
    capsules_.assign(frame.capsules.begin(), frame.capsules.end());
    started_ = true;
    fresh_ = true;
}

/// Lets hair that begins inside capsules come to rest on them, in no time: pushed out in the frames
/// that are seen it would fly off. Speeds are forgotten every few steps, so it creeps and does not
/// swing.
void GuideMotion::settle(const MotionSettings& settings, const MotionFrame& frame) {
    if (!touches_capsules(guides_, state_, frame)) return;
    MotionFrame still = frame;
    still.wind.velocity = glm::vec3(0.0f);
    set_params(settings, still, kSettleSteps, true);
    take_capsules(frame, 1.0, true);
    take_roots(frame, 1.0, true);
    work_.params.memory = 0.0f;
    for (int round = 0; round < kSettleRounds; ++round) {
        simulate(guides_, work_.params, work_.roots, work_.capsules, state_);
    }
    std::ranges::fill(state_.velocity.data, 0.0f);
    fresh_ = true;
}

const MotionWork& GuideMotion::prepare(const MotionSettings& settings, const MotionFrame& given) {
    MotionFrame frame = given;
    assert(frame.roots.size() == guides_.count);
    frame.capsules = frame.capsules.first(std::min(frame.capsules.size(), kMostCapsules));
    work_.params.substeps = 0;
    if (guides_.count == 0) return work_;
    if (!preloaded_) preload(frame);
    const bool began = !started_;
    if (began) {
        begin(frame);
        settle(settings, frame);
        work_.params.substeps = 0;
    }
    if (asleep_) {
        if (!disturbed(settings, frame)) {
            ++counts_.asleep;
            return work_;
        }
        asleep_ = false;
        still_steps_ = 0;
        behind_ = 0.0;
    }
    stirred_ = disturbed(settings, frame);
    settings_ = settings;
    const double dt = sane(frame.dt);
    const double travel = glm::distance(frame.roots[0].place, roots_[0].place);
    const bool jumped = travel > kJump && travel > kJumpSpeed * dt;
    const bool carry = frame.teleported || jumped;
    if (carry) {
        // Shapes are kept in their roots' frames, so they are where the roots are already.
        begin(frame);
        ++counts_.carried;
    }
    behind_ += dt;
    // A millionth of a step forgives the rounding of sums of frame times.
    const double due = std::floor(behind_ / kMotionStep + 1e-6);
    if (due < 1.0) return work_;
    const auto steps = static_cast<uint32_t>(std::min(due, double{kMostMotionSteps}));
    const bool late = due > kMostMotionSteps;
    const double share = late ? 1.0 : std::min(steps * kMotionStep / behind_, 1.0);
    set_params(settings, frame, steps, carry || began);
    take_capsules(frame, share, carry);
    take_roots(frame, share, carry);
    behind_ = late ? 0.0 : std::max(behind_ - steps * kMotionStep, 0.0);
    ++counts_.frames;
    counts_.guide_steps += uint64_t{guides_.count} * steps;
    return work_;
}

void GuideMotion::set_params(const MotionSettings& settings, const MotionFrame& frame,
                             uint32_t steps, bool unmoved) {
    const float bend = std::clamp(settings.bend_length, 1e-3f, 2.0f);
    glsl::RodParams& p = work_.params;
    p.gravity = glm::vec3(0.0f, -9.81f, 0.0f) * settings.gravity;
    p.step = static_cast<float>(kMotionStep);
    p.wind = frame.wind.velocity * settings.wind;
    p.gust = std::clamp(frame.wind.gust, 0.0f, 1.0f);
    // Gust patterns of three sizes pass with the wind; phases wrap in double, so no time is too
    // far.
    const double speed = glm::length(glm::dvec3(frame.wind.velocity)) + 0.3;
    const double start = frame.time - steps * kMotionStep;
    const glm::dvec3 rate = glm::dvec3(0.17, 0.43, 1.3) * speed;
    p.gust_phase = glm::vec3(glm::fract(rate * start));
    p.gust_rate = glm::vec3(rate * kMotionStep);
    p.drag = std::clamp(settings.drag, 0.0f, 100.0f);
    p.stiffness = bend * bend * bend * 9.81f;
    p.twist = std::clamp(settings.twist, 0.05f, 10.0f);
    p.damping = std::clamp(settings.damping, 0.0f, 2.0f);
    p.hold = std::clamp(settings.hold, 0.0f, 100.0f);
    p.friction = std::clamp(settings.friction, 0.0f, 1000.0f);
    p.inertia = 1.0f;
    // Hair that was not there a frame ago goes along with its root, as fast as that turns out to
    // be.
    p.memory = fresh_ ? 0.0f : 1.0f;
    fresh_ = unmoved;
    p.scale = static_cast<float>(frame.scale);
    p.substeps = steps;
    p.capsules = static_cast<uint32_t>(frame.capsules.size());
}

void GuideMotion::take_roots(const MotionFrame& frame, double share, bool carry) {
    const glm::dvec3 anchor = frame.roots[0].place;
    const double seconds = work_.params.substeps * kMotionStep;
    double fastest = 0.0;
    for (size_t i = 0; i < roots_.size(); ++i) {
        RootPose from = roots_[i];
        const RootPose to = mix(from, frame.roots[i], share);
        roots_[i] = to;
        fastest = std::max(fastest, glm::distance(from.place, to.place) / seconds);
        const double turn_speed = angle_between(from.turn, to.turn) / seconds;
        if (turn_speed > kFastestTurn) {
            from.turn = glm::slerp(to.turn, from.turn, kFastestTurn / turn_speed);
        }
        const double step = 1.0 / work_.params.substeps;
        const glm::dquat spin =
            glm::slerp(glm::dquat(1.0, 0.0, 0.0, 0.0), to.turn * glm::conjugate(from.turn), step);
        work_.roots[i] = {.turn = to_vec4(from.turn),
                          .spin = to_vec4(spin),
                          .place0 = glm::vec3(from.place - anchor),
                          .place1 = glm::vec3(to.place - anchor)};
    }
    if (carry) return;
    if (fastest > kFastest) work_.params.inertia = static_cast<float>(kFastest / fastest);
}

void GuideMotion::take_capsules(const MotionFrame& frame, double share, bool carry) {
    const glm::dvec3 anchor = frame.roots[0].place;
    work_.capsules.resize(frame.capsules.size());
    last_capsules_.swap(capsules_);
    capsules_.resize(frame.capsules.size());
    for (size_t i = 0; i < capsules_.size(); ++i) {
        const WorldCapsule& now = frame.capsules[i];
        const auto last = std::ranges::find(last_capsules_, now.id, &WorldCapsule::id);
        const WorldCapsule from = carry || last == last_capsules_.end() ? now : *last;
        const WorldCapsule to = capsules_[i] = mix(from, now, share);
        work_.capsules[i] = {.a0 = glm::vec3(from.a - anchor),
                             .radius = static_cast<float>(to.radius),
                             .b0 = glm::vec3(from.b - anchor),
                             .a1 = glm::vec3(to.a - anchor),
                             .b1 = glm::vec3(to.b - anchor)};
    }
}

bool GuideMotion::advance(const MotionSettings& settings, const MotionFrame& frame) {
    const MotionWork& work = prepare(settings, frame);
    if (work.params.substeps == 0) return false;
    simulate(guides_, work.params, work.roots, work.capsules, state_);
    note_rest(work.params.substeps);
    return true;
}

void GuideMotion::solved_elsewhere() {
    still_steps_ = stirred_ ? 0 : still_steps_ + work_.params.substeps;
    asleep_ = still_steps_ >= kQuietSteps;
}

void GuideMotion::note_rest(uint32_t steps) {
    const bool still = std::ranges::all_of(state_.velocity.data,
                                           [](float v) { return std::abs(v) < kStillSpeed; });
    still_steps_ = still ? still_steps_ + steps : 0;
    if (still_steps_ < kStillSteps) return;
    asleep_ = true;
    std::ranges::fill(state_.velocity.data, 0.0f);
}

}  // namespace vellus::hair
