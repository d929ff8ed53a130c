#include "modules/display/readback.h"

#include <cstring>

#include "engine/frame_graph/context.h"

namespace vellus::display {

using graph::Access;

Result<gpu::Buffer> make_readback(gpu::Device& device, glm::uvec2 size) {
    return gpu::Buffer::create(device, uint64_t{4} * size.x * size.y, gpu::MemoryKind::kReadback,
                               "readback");
}

void describe_readback(scene::RenderFrame& frame, gpu::Buffer& target) {
    describe_readback(frame, frame.display, target);
}

void describe_readback(scene::RenderFrame& frame, graph::ImageHandle picture, gpu::Buffer& target) {
    const auto imported = frame.graph.import_buffer("readback", {target.bytes()}, &target,
                                                    Access::kNone, Access::kHostRead);
    auto pass = frame.graph.add_pass("display/readback", graph::PassKind::kTransfer);
    pass.read(picture, Access::kTransferRead);
    const auto written = pass.write(imported, Access::kTransferWrite, graph::Load::kDiscard);
    pass.execute([picture, written, size = frame.size](graph::PassContext& context) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {size.x, size.y, 1}};
        vkCmdCopyImageToBuffer(context.commands().handle(), context.image(picture),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, context.buffer(written), 1,
                               &region);
    });
    frame.graph.output(written);
}

asset::Image read_picture(const gpu::Buffer& target, glm::uvec2 size) {
    asset::Image image{size.x, size.y, {}};
    image.rgba.resize(size_t{4} * size.x * size.y);
    std::memcpy(image.rgba.data(), target.mapped(), image.rgba.size());
    return image;
}

}  // namespace vellus::display
