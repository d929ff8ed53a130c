#pragma once

#include <cstring>
#include <span>
#include <utility>

#include "engine/gpu/device.h"
#include "engine/gpu/memory.h"

namespace vellus::gpu {

/// A buffer usable for everything, reached by its device address; owns its memory.
class Buffer {
  public:
    Buffer() = default;
    /// `name` must outlive nothing; it is copied. `bytes` of 0 makes a buffer of 16 bytes.
    static Result<Buffer> create(Device& device, uint64_t bytes, MemoryKind kind, const char* name);
    /// A kDevice buffer that holds `contents`.
    static Result<Buffer> upload(Device& device, std::span<const std::byte> contents,
                                 const char* name);
    template <class T>
    static Result<Buffer> upload_span(Device& device, std::span<const T> contents,
                                      const char* name) {
        return upload(device, std::as_bytes(contents), name);
    }
    ~Buffer();
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        swap(other);
        return *this;
    }

    [[nodiscard]] VkBuffer handle() const { return buffer_; }
    [[nodiscard]] VkDeviceAddress address() const { return address_; }
    [[nodiscard]] uint64_t bytes() const { return bytes_; }
    /// CPU view of kUpload and kReadback buffers, else null.
    [[nodiscard]] std::byte* mapped() const { return allocation_.mapped; }
    /// Copies `values` to the start of a kUpload buffer.
    template <class T>
    void write(std::span<const T> values) {
        assert(mapped() && values.size_bytes() <= bytes_);
        std::memcpy(mapped(), values.data(), values.size_bytes());
    }
    /// Copies the start of any buffer back to the CPU and waits for it.
    Result<void> read_back(Device& device, std::span<std::byte> out) const;
    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }

  private:
    void swap(Buffer& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(buffer_, other.buffer_);
        std::swap(address_, other.address_);
        std::swap(bytes_, other.bytes_);
        std::swap(allocation_, other.allocation_);
    }

    Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
    uint64_t bytes_ = 0;
    Allocation allocation_;
};

}  // namespace vellus::gpu
