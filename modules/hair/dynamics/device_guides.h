#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/device.h"
#include "modules/hair/dynamics/guide_motion.h"

namespace vellus::hair {

/// Push constants of shaders/hair/dynamics/solve.comp.glsl.
struct SolvePush {
    VkDeviceAddress params;
    VkDeviceAddress roots;
    VkDeviceAddress capsules;
    VkDeviceAddress shown;
    VkDeviceAddress rest;
    VkDeviceAddress preload;
    VkDeviceAddress rotation;
    VkDeviceAddress velocity;
    VkDeviceAddress tension;
    VkDeviceAddress turns;
    uint32_t count;
    uint32_t stride;
    uint32_t links;
    uint32_t padding = 0;
};
static_assert(sizeof(SolvePush) == 96);

/// Frames whose turns are kept: two may be on their way, and each reads those of the one before.
constexpr uint32_t kTurnSlots = 3;

/// Guides and their state on the device, where a compute shader solves them.
struct DeviceGuides {
    gpu::Buffer rest;
    gpu::Buffer preload;
    /// Rotations, velocities, tensions, then turns: kTurnSlots times guide by guide, link by link,
    /// four signed 16 bit. One buffer, which the frame graph knows.
    gpu::Buffer state;
    /// Frame by frame in turn: parameters, roots, capsules, turns of the roots as shown.
    gpu::Buffer inputs;
    uint32_t guides = 0;
    uint32_t stride = 0;
    uint32_t links = 0;

    /// Columns of `guides` as they are (preload included), in the state given. Errors name the
    /// column that did not fit.
    static Result<DeviceGuides> upload(gpu::Device& device, const GuideSet& guides,
                                       const GuideState& state);
    /// Writes a frame's inputs into a slot; what to dispatch, one thread a guide.
    SolvePush write(uint32_t slot, const MotionWork& work, std::span<const RootPose> shown);
    [[nodiscard]] VkDeviceAddress turns(uint32_t slot) const;

    static constexpr uint32_t kMostCapsules = 32;

  private:
    [[nodiscard]] uint64_t slot_bytes() const;
    [[nodiscard]] uint64_t column_bytes() const { return uint64_t{4} * links * stride; }
};

}  // namespace vellus::hair
