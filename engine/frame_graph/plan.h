#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/frame_graph/records.h"
#include "engine/gpu/vulkan.h"

namespace vellus::graph {

class GraphDescription;

/// Why a barrier stands where it stands.
enum class Reason : uint8_t {
    kFrameStart,  ///< memory is shared with the frames before
    kFirstUse,    ///< a layout for the first use in the frame
    kAlias,       ///< the memory belonged to other resources earlier in the frame
    kReadAfterWrite,
    kWriteAfterRead,
    kWriteAfterWrite,
    kLayoutChange,  ///< read again, in another layout
    kFinalState,    ///< handed to whoever uses the resource after the frame
    kFullBarrier,   ///< the switch asks for it
};

/// One synchronization2 barrier. `resource` kNoIndex or `global`: a VkMemoryBarrier2; else an image
/// or a whole buffer. `from` and `to` are steps, kNoIndex for before or after the frame.
struct Barrier {
    uint32_t resource = kNoIndex;
    uint32_t src_stages = 0;
    uint32_t src_access = 0;
    uint32_t dst_stages = 0;
    uint32_t dst_access = 0;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout new_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    ImageRange range{};
    uint32_t from = kNoIndex;
    uint32_t to = kNoIndex;
    Reason reason = Reason::kFirstUse;
    bool global = false;
};

struct Attachment {
    uint32_t resource = kNoIndex;
    ImageRange range{};
    LoadOp load;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool store = true;
    bool read_only = false;
};

enum class StepKind : uint8_t {
    kPass,
    kPoison,  ///< fills a resource with a pattern where it takes over memory (switch)
};

/// One thing to execute: its barriers first, all in one vkCmdPipelineBarrier2.
struct Step {
    StepKind kind = StepKind::kPass;
    uint32_t index = kNoIndex;  ///< pass, or resource to poison
    uint32_t first_barrier = 0;
    uint32_t barrier_count = 0;
    uint32_t first_attachment = 0;
    uint32_t color_count = 0;  ///< the depth attachment, if any, follows the colors
    bool has_depth = false;
};

/// Where a resource lives and when; pool is kNoIndex, and the steps mean nothing, for what is not
/// transient or not used.
struct Placement {
    uint32_t pool = kNoIndex;
    uint32_t usage = 0;  ///< VkImageUsageFlags or VkBufferUsageFlags of the live accesses
    uint64_t offset = 0;
    uint64_t bytes = 0;
    uint32_t first_step = kNoIndex;
    uint32_t last_step = kNoIndex;  ///< kNoIndex with first_step set: kept to the end of the frame
};

/// One span of device memory; images and buffers never share one (bufferImageGranularity).
struct Pool {
    ResourceKind kind = ResourceKind::kImage;
    uint32_t type_bits = 0;
    uint64_t bytes = 0;
    uint64_t alignment = 1;
};

/// What a frame does, as data: before everything the prologue, then the steps, then the epilogue.
struct Plan {
    std::vector<Barrier> prologue;
    std::vector<Step> steps;
    std::vector<Barrier> barriers;
    std::vector<Barrier> epilogue;
    std::vector<Attachment> attachments;
    std::vector<Placement> placements;  ///< per resource of the description
    std::vector<uint8_t> alive;         ///< per pass of the description
    std::vector<Pool> pools;
    uint64_t transient_bytes = 0;
    uint64_t transient_unaliased_bytes = 0;

    [[nodiscard]] std::span<const Barrier> barriers_of(const Step& step) const {
        return std::span(barriers).subspan(step.first_barrier, step.barrier_count);
    }
};

/// "'hdr': hair/shade (storage write in compute) -> tonemap ...: read after write", one line.
std::string explain(const GraphDescription& graph, const Plan& plan, const Barrier& barrier);
/// The whole plan as text: steps in order, barriers with reasons, placements, culled passes.
std::string explain(const GraphDescription& graph, const Plan& plan);

}  // namespace vellus::graph
