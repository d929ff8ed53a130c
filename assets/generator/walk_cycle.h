#pragma once

#include "assets/generator/skeleton.h"

namespace vellus::sculpt {

/// How the figure walks: one stride is two steps.
struct Gait {
    double stride_seconds = 1.05;
    double stride_metres = 1.20;
    /// Metres; negative or positive: the walk turns left around a point that far to the left.
    /// 0: straight on.
    double turn_radius = 0.0;
};

/// The share of a stride each foot is on the ground.
constexpr double kStance = 0.62;

/// The figure `phase` strides after its left heel came down, hips over the moving origin, facing
/// +Z. Phase 1 is phase 0 again.
Pose walk_pose(const Gait& gait, double phase);

/// Standing at ease at `phase` of a breath: weight on the left leg, a slow look around.
Pose idle_pose(double phase);

/// Where a foot's treading point is, seen from the moving origin: how a point of the ground that
/// was at `start` moves in `strides` strides.
glm::dvec3 ground_after(const Gait& gait, glm::dvec3 start, double strides);

}  // namespace vellus::sculpt
