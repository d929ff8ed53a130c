#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "engine/frame_graph/types.h"
#include "engine/gpu/vulkan.h"

namespace vellus::graph {

/// What an Access means to Vulkan. Stages and access bits are the synchronization2 values; all the
/// graph uses fit 32 bits (ALL_TRANSFER, SHADER_READ, SHADER_WRITE instead of their refinements).
struct alignas(32) AccessInfo {
    uint32_t stages = 0;
    uint32_t access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    uint32_t image_usage = 0;   ///< 0: not for images
    uint32_t buffer_usage = 0;  ///< 0: not for buffers
    bool reads = false;
    bool writes = false;
    uint8_t pass_kinds = 0;  ///< bit per PassKind
    uint8_t targets = 0;     ///< bit per Target
};

/// Access bits that write.
constexpr uint32_t kWriteBits = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                                VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                                VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_WRITE_BIT |
                                VK_ACCESS_MEMORY_WRITE_BIT;
constexpr uint32_t kAllStages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
constexpr uint32_t kAllStagesAndHost = kAllStages | VK_PIPELINE_STAGE_HOST_BIT;
constexpr uint32_t kAllAccess = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;

namespace access_table {

/// The bit of a PassKind or Target.
template <class E>
constexpr uint8_t bit(E value) {
    return static_cast<uint8_t>(1U << static_cast<int>(value));
}
constexpr uint8_t kOutsideRendering = bit(PassKind::kCompute) | bit(PassKind::kTransfer);
constexpr uint8_t kRasterOnly = bit(PassKind::kRaster);
constexpr uint8_t kAnyGpu = kOutsideRendering | kRasterOnly;

constexpr uint32_t kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr uint32_t kVertex = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;
constexpr uint32_t kFragment = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr uint32_t kTests =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr uint32_t kRead = VK_ACCESS_SHADER_READ_BIT;
constexpr uint32_t kWrite = VK_ACCESS_SHADER_WRITE_BIT;
constexpr VkImageLayout kSampledLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageLayout kGeneral = VK_IMAGE_LAYOUT_GENERAL;
constexpr uint32_t kSampled = VK_IMAGE_USAGE_SAMPLED_BIT;
constexpr uint32_t kStorage = VK_IMAGE_USAGE_STORAGE_BIT;
constexpr uint32_t kBuffer = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

using Rows = std::array<AccessInfo, static_cast<size_t>(Access::kCount)>;

/// Which kinds of resource the usages leave.
constexpr Rows with_targets(Rows rows) {
    constexpr uint32_t kDepthOnly = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    constexpr uint32_t kColorOnly = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | kStorage;
    for (AccessInfo& row : rows) {
        const bool host = (row.pass_kinds & bit(PassKind::kHost)) != 0;
        if (row.buffer_usage != 0) row.targets |= bit(Target::kImportedBuffer);
        if (row.buffer_usage != 0 && !host) row.targets |= bit(Target::kTransientBuffer);
        if (row.image_usage == 0) continue;
        if ((row.image_usage & kDepthOnly) == 0) row.targets |= bit(Target::kColorImage);
        if ((row.image_usage & kColorOnly) == 0) row.targets |= bit(Target::kDepthImage);
    }
    return rows;
}

// Stages, access bits, layout, image usage, buffer usage, reads, writes, kinds of pass. In the
// header, so that a call's constant Access folds into what is needed of its row.
inline constexpr Rows kRows = with_targets({{
    // kNone
    {0, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0, 0, false, false, 0},
    // kSampledCompute
    {kCompute, kRead, kSampledLayout, kSampled, 0, true, false, bit(PassKind::kCompute)},
    // kSampledFragment
    {kFragment, kRead, kSampledLayout, kSampled, 0, true, false, kRasterOnly},
    // kSampledVertex
    {kVertex, kRead, kSampledLayout, kSampled, 0, true, false, kRasterOnly},
    // kStorageRead
    {kCompute, kRead, kGeneral, kStorage, kBuffer, true, false, bit(PassKind::kCompute)},
    // kStorageWrite
    {kCompute, kWrite, kGeneral, kStorage, kBuffer, false, true, bit(PassKind::kCompute)},
    // kStorageReadWrite
    {kCompute, kRead | kWrite, kGeneral, kStorage, kBuffer, true, true, bit(PassKind::kCompute)},
    // kGraphicsStorageRead
    {kVertex | kFragment, kRead, kGeneral, kStorage, kBuffer, true, false, kRasterOnly},
    // kFragmentStorageWrite
    {kFragment, kWrite, kGeneral, kStorage, kBuffer, false, true, kRasterOnly},
    // kFragmentStorageReadWrite
    {kFragment, kRead | kWrite, kGeneral, kStorage, kBuffer, true, true, kRasterOnly},
    // kColorAttachment
    {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0, false, true,
     kRasterOnly},
    // kDepthAttachment
    {kTests,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0,
     false, true, kRasterOnly},
    // kDepthReadOnly
    {kTests, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL,
     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0, true, false, kRasterOnly},
    // kVertexBuffer
    {VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, true, false, kRasterOnly},
    // kIndexBuffer
    {VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, VK_ACCESS_INDEX_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_INDEX_BUFFER_BIT, true, false, kRasterOnly},
    // kIndirect
    {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, true, false,
     bit(PassKind::kCompute) | kRasterOnly},
    // kTransferRead
    {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
     VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true, false, kOutsideRendering},
    // kTransferWrite
    {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_DST_BIT,
     VK_BUFFER_USAGE_TRANSFER_DST_BIT, false, true, kOutsideRendering},
    // kHostRead
    {VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, false, bit(PassKind::kHost)},
    // kPresent
    {kAllStages, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0, true,
     false, kAnyGpu},
}});

}  // namespace access_table

constexpr const AccessInfo& info(Access access) {
    assert(access < Access::kCount);
    return access_table::kRows[static_cast<size_t>(access)];
}

constexpr bool is_attachment(Access access) {
    return access == Access::kColorAttachment || access == Access::kDepthAttachment ||
           access == Access::kDepthReadOnly;
}

}  // namespace vellus::graph
