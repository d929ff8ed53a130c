#pragma once

#include "engine/asset/image.h"
#include "engine/gpu/buffer.h"
#include "modules/scene/render_frame.h"

namespace vellus::display {

/// A buffer for one picture of that size, read by the CPU.
Result<gpu::Buffer> make_readback(gpu::Device& device, glm::uvec2 size);

/// Pass "display/readback": copies the finished picture of this frame into `target` and asks the
/// graph for it. `target` must live until the frame is done.
void describe_readback(scene::RenderFrame& frame, gpu::Buffer& target);

/// The same of any of the frame's pictures, e.g. its linear color before the tone map; `target`
/// holds the picture's own texels.
void describe_readback(scene::RenderFrame& frame, graph::ImageHandle picture, gpu::Buffer& target);

/// What a finished frame left there.
asset::Image read_picture(const gpu::Buffer& target, glm::uvec2 size);

}  // namespace vellus::display
