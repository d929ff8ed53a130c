#pragma once

#include <span>

#include "engine/gpu/buffer.h"
#include "engine/gpu/command_buffer.h"

namespace vellus::gpu {

/// Small data the CPU writes and shaders read by address within one frame: views, lights,
/// instances. Memory is reused once the frames in flight have passed; nothing is allocated in a
/// frame.
class UploadRing {
  public:
    /// `frames` may be on their way at once, each with at most `bytes_per_frame`.
    static Result<UploadRing> create(Device& device, uint64_t bytes_per_frame, uint32_t frames);

    /// Starts the next frame; what was pushed `frames` frames ago is overwritten.
    void begin_frame();
    /// Address of a copy of `values`, aligned to 256 bytes (what uniform blocks may ask for); 0
    /// where the frame's memory is used up.
    template <class T>
    [[nodiscard]] VkDeviceAddress push_span(std::span<const T> values) {
        return push_bytes(std::as_bytes(values));
    }
    template <class T>
    [[nodiscard]] VkDeviceAddress push(const T& value) {
        return push_bytes(std::as_bytes(std::span(&value, 1)));
    }
    /// The same as a uniform block.
    template <class T>
    [[nodiscard]] UniformSlice push_uniform(const T& value) {
        const VkDeviceAddress address = push(value);
        return {buffer_.handle(), address == 0 ? 0 : address - buffer_.address(), sizeof(T)};
    }
    [[nodiscard]] VkDeviceAddress address(const UniformSlice& slice) const {
        return buffer_.address() + slice.offset;
    }
    [[nodiscard]] uint64_t bytes() const { return buffer_.bytes(); }

  private:
    VkDeviceAddress push_bytes(std::span<const std::byte> bytes);

    Buffer buffer_;
    uint64_t bytes_per_frame_ = 0;
    uint32_t frames_ = 1;
    uint32_t frame_ = 0;
    uint64_t used_ = 0;
};

}  // namespace vellus::gpu
