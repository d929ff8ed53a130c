#pragma once

#include "engine/frame_graph/description.h"
#include "engine/gpu/device.h"
#include "engine/gpu/upload_ring.h"

namespace vellus::scene {

/// Frames the CPU may be ahead of the device.
constexpr uint32_t kFramesInFlight = 2;

/// The frame being described: its graph and the handles modules pass on to each other. Each pass
/// that changes a picture puts the new version back here. Resource, restarted by begin_frame.
struct RenderFrame {
    gpu::Device* device = nullptr;
    gpu::UploadRing uploads;
    graph::GraphDescription graph;

    glm::uvec2 size{0};
    VkDeviceAddress view = 0;    ///< scene::View
    VkDeviceAddress lights = 0;  ///< light::LightBlock

    graph::ImageHandle color;           ///< linear HDR, RGBA16F
    graph::ImageHandle velocity;        ///< pixels since last frame, RG16F
    graph::ImageHandle depth;           ///< of opaque surfaces, reversed, D32F
    graph::ImageHandle opaque_shadows;  ///< atlas of light::PunctualLight's tiles, D32F
    graph::BufferHandle hair_shadows;   ///< maps of all lights, one after the other
    graph::ImageHandle display;         ///< sRGB-encoded RGBA8: what is shown and saved
};

}  // namespace vellus::scene
