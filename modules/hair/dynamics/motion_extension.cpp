#include "modules/hair/dynamics/motion_extension.h"

#include <array>
#include <string>

namespace vellus::hair {

void read_motion(asset::JsonFields& fields, MotionChoice& motion) {
    MotionSettings& settings = motion.motion.settings;
    fields.number("bend_length", 0.001, 2.0, settings.bend_length);
    fields.number("twist", 0.05, 10.0, settings.twist);
    fields.number("damping", 0.0, 2.0, settings.damping);
    fields.number("drag", 0.0, 100.0, settings.drag);
    fields.number("hold", 0.0, 100.0, settings.hold);
    fields.number("friction", 0.0, 1000.0, settings.friction);
    fields.number("wind", 0.0, 10.0, settings.wind);
    fields.number("gravity", -10.0, 10.0, settings.gravity);
    fields.number("smallest_pixels", 0.0, 10000.0, motion.motion.smallest_pixels);
    fields.boolean("enabled", motion.motion.enabled);
    double guides = motion.guides;
    fields.number("guides", 0.0, 65536.0, guides);
    motion.guides = static_cast<uint32_t>(guides);
    constexpr std::array<std::string_view, 2> kSolvers = {"processor", "device"};
    std::string solver(kSolvers[0]);
    fields.choice("solver", kSolvers, solver);
    motion.motion.solver = solver == kSolvers[1] ? MotionSolver::kDevice : MotionSolver::kProcessor;
}

}  // namespace vellus::hair
