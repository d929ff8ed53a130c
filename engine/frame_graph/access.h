#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <string_view>

#include "engine/frame_graph/types.h"
#include "engine/gpu/vulkan.h"

namespace vellus::graph {

/// What an Access means to Vulkan. Stages and access bits are the synchronization2 values; all the
/// graph uses fit 32 bits (ALL_TRANSFER, SHADER_READ, SHADER_WRITE instead of their refinements).
struct AccessInfo {
    std::string_view name;
    uint32_t stages = 0;
    uint32_t access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    uint32_t image_usage = 0;   ///< 0: not for images
    uint32_t buffer_usage = 0;  ///< 0: not for buffers
    bool reads = false;
    bool writes = false;
    uint8_t pass_kinds = 0;  ///< bit per PassKind
};

extern const std::array<AccessInfo, static_cast<size_t>(Access::kCount)> kAccessTable;

inline const AccessInfo& info(Access access) {
    assert(access < Access::kCount);
    return kAccessTable[static_cast<size_t>(access)];
}

/// Access bits that write.
constexpr uint32_t kWriteBits = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                                VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                                VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_WRITE_BIT |
                                VK_ACCESS_MEMORY_WRITE_BIT;
constexpr uint32_t kAllStages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
constexpr uint32_t kAllStagesAndHost = kAllStages | VK_PIPELINE_STAGE_HOST_BIT;
constexpr uint32_t kAllAccess = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;

}  // namespace vellus::graph
