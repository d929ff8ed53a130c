#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "modules/hair/dynamics/motion_settings.h"

namespace vellus::hair {

/// Where strands are solved.
enum class MotionSolver : uint8_t { kProcessor, kDevice };

/// Why a groom is or is not in motion this frame.
enum class MotionReason : uint8_t {
    kNone,
    kChosen,
    kAsleep,
    kSwitchedOff,
    kOutOfView,
    kTooSmall,
    kMirrored,
};
std::string_view text(MotionReason reason);
/// The effect's name in the plan: "none" or what solves it.
std::string_view motion_id(MotionReason reason, MotionSolver solver);

constexpr uint32_t kNoMotion = ~0U;

/// Beside Hair: its strands move. Without it nothing of motion runs. Given by add_motion.
struct HairMotion {
    MotionSettings settings;
    bool enabled = true;
    /// Hair less than this high or wide in the picture moves rigidly.
    float smallest_pixels = 16.0f;
    MotionSolver solver = MotionSolver::kProcessor;
    uint32_t slot = kNoMotion;                  ///< into HairMotions
    MotionReason reason = MotionReason::kNone;  ///< written each frame
};

/// A capsule that hair does not enter, in the frame of its entity; a sphere where both ends are
/// one.
struct HairCollider {
    glm::vec3 from{0.0f};
    glm::vec3 to{0.0f};
    float radius = 0.1f;
};

}  // namespace vellus::hair
