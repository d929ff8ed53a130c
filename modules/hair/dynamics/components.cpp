#include "modules/hair/dynamics/components.h"

namespace vellus::hair {

std::string_view text(MotionReason reason) {
    switch (reason) {
        case MotionReason::kNone:
            return "off: the groom has no HairMotion";
        case MotionReason::kChosen:
            return "chosen for this groom";
        case MotionReason::kAsleep:
            return "asleep: at rest, and nothing stirs it";
        case MotionReason::kSwitchedOff:
            return "off: switched off";
        case MotionReason::kOutOfView:
            return "off: out of view";
        case MotionReason::kTooSmall:
            return "off: too small in the picture to show it";
        case MotionReason::kMirrored:
            return "off: its node mirrors it";
    }
    return "";
}

std::string_view motion_id(MotionReason reason, MotionSolver solver) {
    if (reason != MotionReason::kChosen) return "none";
    return solver == MotionSolver::kProcessor ? "processor" : "device";
}

}  // namespace vellus::hair
