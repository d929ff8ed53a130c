#include "engine/frame_graph/access.h"

namespace vellus::graph {

namespace {

constexpr uint8_t bit(PassKind kind) {
    return static_cast<uint8_t>(1U << static_cast<int>(kind));
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

}  // namespace

const std::array<AccessInfo, static_cast<size_t>(Access::kCount)> kAccessTable = {{
    {"nothing", 0, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0, 0, false, false, 0},
    {"sampled in compute", kCompute, kRead, kSampledLayout, kSampled, 0, true, false,
     bit(PassKind::kCompute)},
    {"sampled in fragment", kFragment, kRead, kSampledLayout, kSampled, 0, true, false,
     kRasterOnly},
    {"sampled in vertex", kVertex, kRead, kSampledLayout, kSampled, 0, true, false, kRasterOnly},
    {"storage read in compute", kCompute, kRead, kGeneral, kStorage, kBuffer, true, false,
     bit(PassKind::kCompute)},
    {"storage write in compute", kCompute, kWrite, kGeneral, kStorage, kBuffer, false, true,
     bit(PassKind::kCompute)},
    {"storage read and write in compute", kCompute, kRead | kWrite, kGeneral, kStorage, kBuffer,
     true, true, bit(PassKind::kCompute)},
    {"storage read in vertex and fragment", kVertex | kFragment, kRead, kGeneral, kStorage, kBuffer,
     true, false, kRasterOnly},
    {"storage write in fragment", kFragment, kWrite, kGeneral, kStorage, kBuffer, false, true,
     kRasterOnly},
    {"storage read and write in fragment", kFragment, kRead | kWrite, kGeneral, kStorage, kBuffer,
     true, true, kRasterOnly},
    {"color attachment", VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0, false, true,
     kRasterOnly},
    {"depth attachment", kTests,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0,
     false, true, kRasterOnly},
    {"depth test", kTests, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0, true,
     false, kRasterOnly},
    {"vertex buffer", VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, true, false, kRasterOnly},
    {"index buffer", VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, VK_ACCESS_INDEX_READ_BIT,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, true, false, kRasterOnly},
    {"indirect arguments", VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, true, false,
     bit(PassKind::kCompute) | kRasterOnly},
    {"transfer source", VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
     VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true, false, kOutsideRendering},
    {"transfer destination", VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_DST_BIT,
     VK_BUFFER_USAGE_TRANSFER_DST_BIT, false, true, kOutsideRendering},
    {"host read", VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, false, bit(PassKind::kHost)},
    {"present", kAllStages, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
     0, true, false, kAnyGpu},
}};

}  // namespace vellus::graph
