#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/gpu/vulkan.h"

namespace vellus::gpu {

enum class MemoryKind : uint8_t {
    kDevice,    ///< fastest for the device; may not be mapped
    kUpload,    ///< mapped, written by the CPU in order
    kReadback,  ///< mapped and cached, read by the CPU
};

/// A piece of a memory block; `mapped` is null for memory the CPU cannot see.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t offset = 0;
    uint64_t bytes = 0;
    std::byte* mapped = nullptr;
    uint32_t block = 0;
};

/// Sub-allocates blocks of 64 MiB per memory type; first fit, freed neighbours merge. Thread-safe.
class MemoryAllocator {
  public:
    MemoryAllocator(VkDevice device, VkPhysicalDevice physical);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    /// Errors name `what` and how much was asked for.
    Result<Allocation> allocate(const VkMemoryRequirements& needs, MemoryKind kind, bool linear,
                                const char* what);
    void free(const Allocation& allocation);
    /// Bytes in use by live allocations.
    [[nodiscard]] uint64_t bytes_in_use() const;

  private:
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        uint64_t bytes = 0;
        uint32_t type = 0;
        bool linear = true;
        std::byte* mapped = nullptr;
        std::map<uint64_t, uint64_t> holes;  // offset -> bytes
    };

    Result<uint32_t> find_type(uint32_t allowed, MemoryKind kind, const char* what) const;
    Result<uint32_t> add_block(uint32_t type, uint64_t bytes, bool linear, const char* what);
    static bool take(Block& block, const VkMemoryRequirements& needs, Allocation& out);

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    mutable std::mutex mutex_;
    std::vector<Block> blocks_;
    uint64_t in_use_ = 0;
};

}  // namespace vellus::gpu
