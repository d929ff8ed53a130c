#pragma once

#include "engine/ecs/schedule.h"

// The sets of systems a frame runs through, in this order. Systems of one set run in parallel where
// they do not conflict; all that describe passes share the RenderFrame, so each has a set of its
// own.
namespace vellus::scene {

constexpr const char* kSimulate = "simulate";      ///< input, animation, motion
constexpr const char* kTransforms = "transforms";  ///< local to world, bounds
constexpr const char* kView = "view";              ///< jitter, camera, start of the frame graph
constexpr const char* kGather = "gather";          ///< lights, instances: what this frame draws
constexpr const char* kLighting = "lighting";      ///< passes: light block, empty shadow maps
constexpr const char* kSkinning = "skinning";      ///< passes: vertices of animated meshes
constexpr const char* kStrands = "strands";        ///< passes: points of hair on the screen
constexpr const char* kCasters = "casters";        ///< passes: opaque meshes into shadow maps
constexpr const char* kShadows = "shadows";        ///< passes: hair into shadow maps
constexpr const char* kOpaque = "opaque";          ///< passes: meshes
constexpr const char* kSky = "sky";                ///< passes: the background
constexpr const char* kHair = "hair";              ///< passes: hair into the picture
constexpr const char* kTemporal = "temporal";      ///< passes: history
constexpr const char* kDisplay = "display";        ///< passes: tone map, output

inline void order_stages(Schedule& schedule) {
    schedule.order({kSimulate, kTransforms, kView, kGather, kLighting, kSkinning, kStrands,
                    kCasters, kShadows, kOpaque, kSky, kHair, kTemporal, kDisplay});
}

}  // namespace vellus::scene
