#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "engine/ecs/system.h"
#include "engine/frame_graph/description.h"
#include "engine/gpu/device.h"
#include "engine/gpu/pipeline_library.h"
#include "engine/gpu/upload_ring.h"
#include "modules/scene/pixel_rect.h"
#include "modules/scene/view.h"

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
    uint32_t frame_index = 0;
    float pixel_angle = 0.0f;        ///< width of a pixel at 1 m, metres
    VkDeviceAddress view = 0;        ///< scene::View
    VkDeviceAddress lights = 0;      ///< light::LightBlock
    gpu::UniformSlice view_block;    ///< the same two as uniform blocks, which a CPU device reads
    gpu::UniformSlice lights_block;  ///< once for all lanes

    graph::ImageHandle color;           ///< linear HDR, RGBA16F
    graph::ImageHandle velocity;        ///< pixels since last frame, RG16F
    graph::ImageHandle depth;           ///< of opaque surfaces, reversed, D32F
    graph::ImageHandle opaque_shadows;  ///< atlas of light::PunctualLight's tiles, D32F
    graph::BufferHandle hair_shadows;   ///< maps of all lights, one after the other
    graph::BufferHandle hair_layers;    ///< deep opacity maps of all lights; invalid where none are
    PixelRect hair_pixels;              ///< no hair is drawn outside
    graph::ImageHandle display;         ///< sRGB-encoded RGBA8: what is shown and saved

    /// The first thing that went wrong while describing; the host reports it and stops.
    std::optional<Error> error;

    void fail(const Error& problem) {
        if (!error) error = problem;
    }
    /// Makes a pipeline the first time it is needed; false, with `error` set, where that fails.
    template <class Info>
    bool compute(const gpu::Pipeline*& slot, const Info& info) {
        return slot || keep(slot, device->pipelines().compute(info()));
    }
    template <class Info>
    bool raster(const gpu::Pipeline*& slot, const Info& info) {
        return slot || keep(slot, device->pipelines().raster(info()));
    }

  private:
    bool keep(const gpu::Pipeline*& slot, const Result<const gpu::Pipeline*>& made) {
        if (!made) {
            fail(made.error());
            return false;
        }
        slot = *made;
        return true;
    }
};

/// Formats of the pictures in a RenderFrame.
constexpr gpu::Format kColorFormat = gpu::Format::kRgba16Float;
constexpr gpu::Format kVelocityFormat = gpu::Format::kRg16Float;
constexpr gpu::Format kDepthFormat = gpu::Format::kD32Float;

/// Puts a RenderFrame for this device into the world; before register_scene.
Result<void> insert_render_frame(World& world, gpu::Device& device);

/// System: forgets last frame's graph and starts with black, unmoved, infinitely far pictures.
void begin_frame(Res<const ViewState> state, Res<RenderFrame> frame);

}  // namespace vellus::scene
