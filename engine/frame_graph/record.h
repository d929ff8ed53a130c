#pragma once

// From steps to commands; internal to this folder.

#include <vector>

#include "engine/frame_graph/context.h"
#include "engine/frame_graph/description.h"
#include "engine/frame_graph/physical.h"

namespace vellus::graph {

/// What recording needs to know of the frame.
struct RecordInput {
    gpu::Device* device = nullptr;
    const GraphDescription* graph = nullptr;
    const Plan* plan = nullptr;
    std::vector<Physical>* physical = nullptr;
    Graveyard* graveyard = nullptr;
    Diagnostics* diagnostics = nullptr;
    uint64_t frame = 0;
    uint64_t* created = nullptr;
    /// Handed to passes that ask for what they did not declare.
    Physical placeholder;
};

class Recorder {
  public:
    void begin(const RecordInput& input) {
        in_ = input;
        failure_ = VK_SUCCESS;
    }
    void barriers(VkCommandBuffer commands, std::span<const Barrier> batch);
    /// Sets history images that hold nothing of use to zero and leaves them readable.
    void clear_history(VkCommandBuffer commands, std::span<const uint32_t> resources);
    void poison(VkCommandBuffer commands, uint32_t resource);
    /// The pass's own commands, inside its rendering if it is a raster pass.
    void pass(gpu::CommandBuffer& commands, const Step& step);
    /// The first Vulkan call that failed while recording.
    [[nodiscard]] VkResult failure() const { return failure_; }

  private:
    class Context;

    VkImageView view(uint32_t resource, const ImageRange& range);
    void begin_rendering(VkCommandBuffer commands, const Step& step);
    [[nodiscard]] VkRenderingAttachmentInfo attachment_info(const Attachment& attachment);
    [[nodiscard]] const ResourceRecord& record(uint32_t resource) const {
        return in_.graph->resources()[resource];
    }

    RecordInput in_;
    VkResult failure_ = VK_SUCCESS;
    std::vector<VkMemoryBarrier2> memory_barriers_;
    std::vector<VkBufferMemoryBarrier2> buffer_barriers_;
    std::vector<VkImageMemoryBarrier2> image_barriers_;
    std::vector<ViewOfRange> one_view_;
};

}  // namespace vellus::graph
