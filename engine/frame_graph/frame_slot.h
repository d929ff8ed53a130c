#pragma once

// Command buffers, fence and timestamps of one frame in flight; internal to this folder.

#include <string>
#include <string_view>
#include <vector>

#include "engine/frame_graph/execute.h"

namespace vellus::graph {

class FrameSlot {
  public:
    static Result<FrameSlot> create(gpu::Device& device);
    ~FrameSlot();
    FrameSlot(FrameSlot&& other) noexcept { swap(other); }
    FrameSlot& operator=(FrameSlot&& other) noexcept {
        swap(other);
        return *this;
    }

    /// Starts recording a frame of `steps` steps.
    Result<void> begin(uint64_t frame, size_t steps, VkSemaphore wait);
    [[nodiscard]] VkCommandBuffer commands() const { return buffers_[used_ - 1]; }
    /// A timestamp once everything recorded so far is done.
    void mark();
    void begin_label(std::string_view name);
    void end_label();
    /// Submits what was recorded, waits for it, and goes on in a new command buffer.
    Result<void> flush();
    Result<void> submit(VkSemaphore signal);
    /// Drops what was recorded since the last flush.
    void abandon();

    /// Reused from frame to frame, names included.
    PassReport& add_pass(std::string_view name);
    [[nodiscard]] FrameReport& report() { return report_; }
    [[nodiscard]] bool in_flight() const { return in_flight_; }
    Result<void> wait();
    /// Reads the timestamps of the finished frame and exchanges the report for `out`.
    void collect(FrameReport& out);

  private:
    FrameSlot() = default;
    void swap(FrameSlot& other) noexcept;
    Result<void> next_buffer();
    Result<void> submit_buffer(VkSemaphore signal, VkFence fence);

    gpu::Device* device_ = nullptr;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::vector<VkCommandBuffer> buffers_;
    size_t used_ = 0;
    VkFence fence_ = VK_NULL_HANDLE;
    VkSemaphore wait_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    uint32_t query_capacity_ = 0;
    uint32_t query_count_ = 0;
    std::vector<uint64_t> times_;
    std::string label_;
    FrameReport report_;
    size_t pass_count_ = 0;
    bool in_flight_ = false;
};

}  // namespace vellus::graph
