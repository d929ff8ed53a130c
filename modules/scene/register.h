#pragma once

#include "engine/ecs/schedule.h"
#include "engine/ecs/world.h"

namespace vellus::scene {

/// Sets of systems, in the order a frame runs them; see register_scene.
constexpr std::string_view kSimulate = "simulate";    ///< game and input
constexpr std::string_view kAnimate = "animate";      ///< writes LocalTransform
constexpr std::string_view kTransform = "transform";  ///< LocalTransform -> WorldTransform
constexpr std::string_view kView = "view";            ///< the frame's View
constexpr std::string_view kDeform = "deform";        ///< palettes, bounds, strand attachments

/// Resources SceneLibrary, FixedStep, ViewSettings, ViewState, Hierarchy (where the world has none)
/// and the systems propagate_transforms and update_view; orders the sets above.
void register_scene(World& world, Schedule& schedule);

}  // namespace vellus::scene
