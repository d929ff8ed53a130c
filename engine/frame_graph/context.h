#pragma once

#include "engine/frame_graph/types.h"
#include "engine/gpu/command_buffer.h"

namespace vellus::graph {

/// What a pass sees while it records: its command buffer and the resources it declared. Asking for
/// anything else gives a placeholder and an error (undeclared access), and the frame is not
/// submitted. A raster pass is called inside its rendering, viewport and scissor set to the whole
/// attachment.
class PassContext {
  public:
    virtual ~PassContext() = default;

    virtual gpu::CommandBuffer& commands() = 0;
    virtual VkImage image(ImageHandle image) = 0;
    /// The declared range as a 2D view (2D array where it has several layers).
    virtual VkImageView view(ImageHandle image) = 0;
    /// Part of it: for a pass that declared several ranges of one image.
    virtual VkImageView view(ImageHandle image, ImageRange range) = 0;
    virtual VkBuffer buffer(BufferHandle buffer) = 0;
    virtual VkDeviceAddress address(BufferHandle buffer) = 0;
    /// False on the first frame, after a resize, and where the description says restart.
    virtual bool history_valid(ImageHandle previous) = 0;
    [[nodiscard]] virtual const ImageDesc& desc(ImageHandle image) = 0;
    /// Counts frames executed so far, from 0.
    [[nodiscard]] virtual uint64_t frame() const = 0;
};

}  // namespace vellus::graph
