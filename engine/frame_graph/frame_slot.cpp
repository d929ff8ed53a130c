#include "engine/frame_graph/frame_slot.h"

#include <utility>

namespace vellus::graph {

Result<FrameSlot> FrameSlot::create(gpu::Device& device) {
    FrameSlot slot;
    slot.device_ = &device;
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                       .queueFamilyIndex = device.queue_family()};
    VkResult result = vkCreateCommandPool(device.handle(), &pool, nullptr, &slot.pool_);
    const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    if (result == VK_SUCCESS) {
        result = vkCreateFence(device.handle(), &fence, nullptr, &slot.fence_);
    }
    if (result != VK_SUCCESS) return gpu::vulkan_error(result, "frame in flight");
    return slot;
}

FrameSlot::~FrameSlot() {
    if (!device_) return;
    vkDestroyQueryPool(device_->handle(), queries_, nullptr);
    vkDestroyFence(device_->handle(), fence_, nullptr);
    vkDestroyCommandPool(device_->handle(), pool_, nullptr);
}

void FrameSlot::swap(FrameSlot& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(buffers_, other.buffers_);
    std::swap(used_, other.used_);
    std::swap(fence_, other.fence_);
    std::swap(wait_, other.wait_);
    std::swap(queries_, other.queries_);
    std::swap(query_capacity_, other.query_capacity_);
    std::swap(query_count_, other.query_count_);
    std::swap(times_, other.times_);
    std::swap(label_, other.label_);
    std::swap(report_, other.report_);
    std::swap(pass_count_, other.pass_count_);
    std::swap(in_flight_, other.in_flight_);
}

Result<void> FrameSlot::next_buffer() {
    if (used_ == buffers_.size()) {
        const VkCommandBufferAllocateInfo info{
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .commandPool = pool_,
            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
            .commandBufferCount = 1};
        VkCommandBuffer buffer = VK_NULL_HANDLE;
        if (const VkResult result = vkAllocateCommandBuffers(device_->handle(), &info, &buffer);
            result != VK_SUCCESS) {
            return gpu::vulkan_error(result, "command buffer");
        }
        buffers_.push_back(buffer);
    }
    ++used_;
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    if (const VkResult result = vkBeginCommandBuffer(commands(), &info); result != VK_SUCCESS) {
        return gpu::vulkan_error(result, "command buffer");
    }
    return {};
}

Result<void> FrameSlot::begin(uint64_t frame, size_t steps, VkSemaphore wait) {
    vkResetCommandPool(device_->handle(), pool_, 0);
    used_ = 0;
    pass_count_ = 0;
    query_count_ = 0;
    wait_ = wait;
    report_.index = frame - 1;
    const auto marks = static_cast<uint32_t>(steps) + 3;
    if (query_capacity_ < marks) {
        vkDestroyQueryPool(device_->handle(), queries_, nullptr);
        queries_ = VK_NULL_HANDLE;
        query_capacity_ = marks * 2;
        const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                         .queryCount = query_capacity_};
        if (const VkResult result = vkCreateQueryPool(device_->handle(), &info, nullptr, &queries_);
            result != VK_SUCCESS) {
            query_capacity_ = 0;
            return gpu::vulkan_error(result, "timestamps");
        }
    }
    if (auto made = next_buffer(); !made) return made;
    vkCmdResetQueryPool(commands(), queries_, 0, marks);
    return {};
}

void FrameSlot::mark() {
    vkCmdWriteTimestamp2(commands(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_,
                         query_count_++);
}

void FrameSlot::begin_label(std::string_view name) {
    if (!vkCmdBeginDebugUtilsLabelEXT) return;
    label_ = name;
    const VkDebugUtilsLabelEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                    .pLabelName = label_.c_str()};
    vkCmdBeginDebugUtilsLabelEXT(commands(), &info);
}

void FrameSlot::end_label() {
    if (vkCmdEndDebugUtilsLabelEXT) vkCmdEndDebugUtilsLabelEXT(commands());
}

Result<void> FrameSlot::submit_buffer(VkSemaphore signal, VkFence fence) {
    VkResult result = vkEndCommandBuffer(commands());
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = commands()};
    const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = wait_,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSemaphoreSubmitInfo done{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = signal,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .waitSemaphoreInfoCount = wait_ ? 1U : 0U,
                               .pWaitSemaphoreInfos = &wait,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &buffer,
                               .signalSemaphoreInfoCount = signal ? 1U : 0U,
                               .pSignalSemaphoreInfos = &done};
    if (result == VK_SUCCESS) result = vkQueueSubmit2(device_->queue(), 1, &submit, fence);
    if (result != VK_SUCCESS) return gpu::vulkan_error(result, "submitting the frame");
    wait_ = VK_NULL_HANDLE;
    return {};
}

Result<void> FrameSlot::flush() {
    if (auto submitted = submit_buffer(VK_NULL_HANDLE, VK_NULL_HANDLE); !submitted) {
        return submitted;
    }
    if (const VkResult result = vkQueueWaitIdle(device_->queue()); result != VK_SUCCESS) {
        return gpu::vulkan_error(result, "waiting for a pass");
    }
    return next_buffer();
}

Result<void> FrameSlot::submit(VkSemaphore signal) {
    if (auto submitted = submit_buffer(signal, fence_); !submitted) return submitted;
    in_flight_ = true;
    report_.passes.resize(pass_count_);
    return {};
}

void FrameSlot::abandon() {
    vkEndCommandBuffer(commands());
}

PassReport& FrameSlot::add_pass(std::string_view name) {
    if (pass_count_ == report_.passes.size()) report_.passes.emplace_back();
    PassReport& pass = report_.passes[pass_count_++];
    pass.name = name;
    return pass;
}

Result<void> FrameSlot::wait() {
    if (const VkResult result =
            vkWaitForFences(device_->handle(), 1, &fence_, VK_TRUE, ~uint64_t{0});
        result != VK_SUCCESS) {
        return gpu::vulkan_error(result, "waiting for a frame");
    }
    vkResetFences(device_->handle(), 1, &fence_);
    in_flight_ = false;
    return {};
}

void FrameSlot::collect(FrameReport& out) {
    times_.resize(query_count_);
    vkGetQueryPoolResults(device_->handle(), queries_, 0, query_count_,
                          times_.size() * sizeof(uint64_t), times_.data(), sizeof(uint64_t),
                          VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    const double period = static_cast<double>(device_->traits().timestamp_period_ns) * 1e-6;
    const auto between = [&](size_t from, size_t to) {
        return static_cast<double>(times_[to] - times_[from]) * period;
    };
    // Marks: start, end of the prologue, end of each step, end.
    double sum = 0;
    for (size_t i = 0; i < report_.passes.size(); ++i) {
        report_.passes[i].gpu_ms = between(i + 1, i + 2);
        sum += report_.passes[i].gpu_ms;
    }
    report_.gpu_ms = between(0, query_count_ - 1);
    report_.unattributed_ms = report_.gpu_ms - sum;
    std::swap(out, report_);
}

}  // namespace vellus::graph
