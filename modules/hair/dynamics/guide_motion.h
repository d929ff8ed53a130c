#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "modules/hair/dynamics/guides.h"
#include "modules/hair/dynamics/motion_settings.h"
#include "modules/hair/dynamics/rod.h"

namespace vellus::hair {

/// Seconds of one step of the solver, whatever the frame rate.
constexpr double kMotionStep = 1.0 / 240.0;
/// Steps one frame may take: frames longer than a quarter second run in slow motion.
constexpr uint32_t kMostMotionSteps = 60;

/// Where a guide's root is in the world, metres; `turn` takes the guide's rest to the world.
struct RootPose {
    glm::dvec3 place{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
};

/// A capsule in the world, metres; a sphere where both ends are one.
struct WorldCapsule {
    glm::dvec3 a{0.0};
    glm::dvec3 b{0.0};
    double radius = 0.0;
    uint64_t id = 0;  ///< the same from frame to frame, for its speed
};

/// What a frame brings to a groom in motion.
struct MotionFrame {
    double dt = 0.0;                         ///< seconds; less than 0 or not finite counts as 0
    double time = 0.0;                       ///< seconds at the end of the frame, for gusts
    double scale = 1.0;                      ///< metres in the world per metre of the guides
    bool teleported = false;                 ///< roots jumped: nothing is felt of it
    std::span<const RootPose> roots;         ///< at the end of the frame, one per guide
    std::span<const WorldCapsule> capsules;  ///< the same; beyond 32 none counts
    Wind wind;
};

/// What motion has cost so far.
struct MotionCounts {
    uint64_t frames = 0;       ///< in which at least one step was taken
    uint64_t guide_steps = 0;  ///< guides times steps
    uint64_t asleep = 0;       ///< frames slept through
    uint64_t carried = 0;      ///< teleports
};

/// What the solver is to do this frame; `steps` 0: nothing.
struct MotionWork {
    glsl::RodParams params{};
    std::vector<glsl::RodRoot> roots;
    std::vector<glsl::RodCapsule> capsules;
};

/// Guides of one groom in motion, on the CPU. Everything near 1 in size reaches the solver: roots
/// and capsules are taken in double relative to the first root. The groom is taken to rest as it is
/// in the first frame's pose: set_preload with that frame's roots. Where that pose has capsules in
/// it, for a body does not stand as it was groomed, hair comes to rest on them before it is seen.
class GuideMotion {
  public:
    explicit GuideMotion(GuideSet guides);

    /// Moves the guides to the end of the frame. True where they moved.
    bool advance(const MotionSettings& settings, const MotionFrame& frame);
    /// The first half of it: takes the frame in and says what to solve. For solvers elsewhere.
    const MotionWork& prepare(const MotionSettings& settings, const MotionFrame& frame);
    /// The second half where another solver did the work, whose state is not seen here: hair counts
    /// as at rest once nothing has stirred it for 2.5 s.
    void solved_elsewhere();
    /// Back to the groom as loaded, at rest, wherever the roots are next.
    void reset();

    [[nodiscard]] const MotionWork& work() const { return work_; }
    [[nodiscard]] const GuideSet& guides() const { return guides_; }
    [[nodiscard]] const GuideState& state() const { return state_; }
    [[nodiscard]] const MotionCounts& counts() const { return counts_; }
    [[nodiscard]] bool asleep() const { return asleep_; }

  private:
    [[nodiscard]] bool disturbed(const MotionSettings& settings, const MotionFrame& frame) const;
    void preload(const MotionFrame& frame);
    void begin(const MotionFrame& frame);
    void settle(const MotionSettings& settings, const MotionFrame& frame);
    void set_params(const MotionSettings& settings, const MotionFrame& frame, uint32_t steps,
                    bool unmoved);
    void take_roots(const MotionFrame& frame, double share, bool carry);
    void take_capsules(const MotionFrame& frame, double share, bool carry);
    void note_rest(uint32_t steps);

    GuideSet guides_;
    GuideState state_;
    MotionCounts counts_;
    MotionWork work_;
    // Where things were when the solver stopped, up to a step before the frame's end.
    std::vector<RootPose> roots_;
    std::vector<WorldCapsule> capsules_;
    std::vector<WorldCapsule> last_capsules_;
    MotionSettings settings_;
    double behind_ = 0.0;  ///< seconds from there to the frame's end
    uint32_t still_steps_ = 0;
    bool stirred_ = false;
    bool started_ = false;
    bool fresh_ = true;  ///< speeds are not known yet
    bool preloaded_ = false;
    bool asleep_ = false;
};

}  // namespace vellus::hair
