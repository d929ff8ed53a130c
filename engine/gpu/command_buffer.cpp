#include "engine/gpu/command_buffer.h"

namespace vellus::gpu {

namespace {
constexpr size_t kMaxBindings = 16;
/// maxComputeWorkGroupCount is at least this on every device (Vulkan 1.3, table 51).
constexpr uint32_t kMostGroups = 65535;
}

void CommandBuffer::bind(const Pipeline& pipeline) {
    pipeline_ = &pipeline;
    vkCmdBindPipeline(handle_, pipeline.bind_point, pipeline.handle);
}

void CommandBuffer::images(std::initializer_list<VkImageView> views,
                           std::initializer_list<UniformSlice> uniforms) {
    images(std::span(views.begin(), views.size()), std::span(uniforms.begin(), uniforms.size()));
}

void CommandBuffer::images(std::span<const VkImageView> views,
                           std::span<const UniformSlice> uniforms) {
    const size_t count = views.size() + uniforms.size();
    assert(pipeline_ && count == pipeline_->bindings.size() && count <= kMaxBindings);
    VkDescriptorImageInfo images[kMaxBindings];
    VkDescriptorBufferInfo buffers[kMaxBindings];
    VkWriteDescriptorSet writes[kMaxBindings];
    for (uint32_t slot = 0; slot < count; ++slot) {
        const Binding binding = pipeline_->bindings[slot];
        assert((binding == Binding::kUniform) == (slot >= views.size()));
        writes[slot] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                        .dstBinding = slot,
                        .descriptorCount = 1,
                        .descriptorType = descriptor_type(binding)};
        if (binding == Binding::kUniform) {
            const UniformSlice& slice = uniforms[slot - views.size()];
            buffers[slot] = {slice.buffer, slice.offset, slice.bytes};
            writes[slot].pBufferInfo = &buffers[slot];
        } else {
            images[slot] = {.imageView = views[slot],
                            .imageLayout = binding == Binding::kStorage
                                               ? VK_IMAGE_LAYOUT_GENERAL
                                               : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
            writes[slot].pImageInfo = &images[slot];
        }
    }
    vkCmdPushDescriptorSetKHR(handle_, pipeline_->bind_point, pipeline_->layout, 0,
                              static_cast<uint32_t>(count), writes);
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

void CommandBuffer::dispatch_threads(uint32_t threads, uint32_t group_size) {
    const uint32_t groups = threads / group_size + (threads % group_size != 0 ? 1 : 0);
    const uint32_t rows = groups / kMostGroups + (groups % kMostGroups != 0 ? 1 : 0);
    dispatch(rows > 1 ? (groups + rows - 1) / rows : groups, rows > 1 ? rows : 1);
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
