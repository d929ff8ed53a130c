#include "engine/gpu/command_buffer.h"

namespace vellus::gpu {

namespace {
constexpr size_t kMaxImages = 16;
}

void CommandBuffer::bind(const Pipeline& pipeline) {
    pipeline_ = &pipeline;
    vkCmdBindPipeline(handle_, pipeline.bind_point, pipeline.handle);
}

void CommandBuffer::images(std::initializer_list<VkImageView> views) {
    images(std::span(views.begin(), views.size()));
}

void CommandBuffer::images(std::span<const VkImageView> views) {
    assert(pipeline_ && views.size() == pipeline_->bindings.size() && views.size() <= kMaxImages);
    VkDescriptorImageInfo infos[kMaxImages];
    VkWriteDescriptorSet writes[kMaxImages];
    for (uint32_t slot = 0; slot < views.size(); ++slot) {
        const bool storage = pipeline_->bindings[slot] == Binding::kStorage;
        infos[slot] = {.imageView = views[slot],
                       .imageLayout = storage ? VK_IMAGE_LAYOUT_GENERAL
                                              : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        writes[slot] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                        .dstBinding = slot,
                        .descriptorCount = 1,
                        .descriptorType = storage ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                                  : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                        .pImageInfo = &infos[slot]};
    }
    vkCmdPushDescriptorSetKHR(handle_, pipeline_->bind_point, pipeline_->layout, 0,
                              static_cast<uint32_t>(views.size()), writes);
}

void CommandBuffer::push_bytes(const void* bytes, uint32_t size) {
    const VkShaderStageFlags stages =
        pipeline_->bind_point == VK_PIPELINE_BIND_POINT_COMPUTE
            ? VK_SHADER_STAGE_COMPUTE_BIT
            : VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    vkCmdPushConstants(handle_, pipeline_->layout, stages, 0, size, bytes);
}

void CommandBuffer::dispatch(uint32_t groups_x, uint32_t groups_y, uint32_t groups_z) {
    vkCmdDispatch(handle_, groups_x, groups_y, groups_z);
    ++dispatches_;
}

void CommandBuffer::draw(uint32_t vertices, uint32_t instances, uint32_t first_vertex) {
    vkCmdDraw(handle_, vertices, instances, first_vertex, 0);
    ++draws_;
}

void CommandBuffer::draw_indexed(VkBuffer buffer, uint32_t indices, uint32_t instances) {
    vkCmdBindIndexBuffer(handle_, buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(handle_, indices, instances, 0, 0, 0);
    ++draws_;
}

}  // namespace vellus::gpu
