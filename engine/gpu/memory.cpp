#include "engine/gpu/memory.h"

#include <algorithm>
#include <optional>

namespace vellus::gpu {

namespace {

constexpr uint64_t kBlockBytes = 64ull << 20;

struct Wish {
    VkMemoryPropertyFlags required;
    VkMemoryPropertyFlags preferred;
};

Wish wish_for(MemoryKind kind) {
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (kind) {
        case MemoryKind::kDevice:
            return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
        case MemoryKind::kUpload:
            return {kMapped, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
        case MemoryKind::kReadback:
            return {kMapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    }
    return {};
}

constexpr uint64_t align_up(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

MemoryAllocator::MemoryAllocator(VkDevice device, VkPhysicalDevice physical) : device_(device) {
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

MemoryAllocator::~MemoryAllocator() {
    for (const Block& block : blocks_) vkFreeMemory(device_, block.memory, nullptr);
}

Result<uint32_t> MemoryAllocator::find_type(uint32_t allowed, MemoryKind kind,
                                            const char* what) const {
    const auto [required, preferred] = wish_for(kind);
    std::optional<uint32_t> fallback;
    for (uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags flags = properties_.memoryTypes[type].propertyFlags;
        if (!(allowed & (1u << type)) || (flags & required) != required) continue;
        if ((flags & preferred) == preferred) return type;
        if (!fallback) fallback = type;
    }
    if (fallback) return *fallback;
    return Error{"no memory type fits", what, "pick another --device"};
}

Result<uint32_t> MemoryAllocator::add_block(uint32_t type, uint64_t bytes, bool linear,
                                            const char* what) {
    const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                          .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .pNext = &flags,
                                    .allocationSize = bytes,
                                    .memoryTypeIndex = type};
    Block block{.bytes = bytes, .type = type, .linear = linear, .holes = {{0, bytes}}};
    if (const VkResult result = vkAllocateMemory(device_, &info, nullptr, &block.memory);
        result != VK_SUCCESS) {
        return vulkan_error(
            result, fmt::format("{} ({:.1f} MiB)", what, static_cast<double>(bytes) / (1 << 20)));
    }
    if (properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
        void* mapped = nullptr;
        const VkResult result = vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) {
            vkFreeMemory(device_, block.memory, nullptr);
            return vulkan_error(result, fmt::format("mapping {}", what));
        }
        block.mapped = static_cast<std::byte*>(mapped);
    }
    const auto unused = std::ranges::find(blocks_, VkDeviceMemory{VK_NULL_HANDLE}, &Block::memory);
    const auto index = static_cast<uint32_t>(unused - blocks_.begin());
    if (unused == blocks_.end()) {
        blocks_.push_back(std::move(block));
    } else {
        *unused = std::move(block);
    }
    return index;
}

bool MemoryAllocator::take(Block& block, const VkMemoryRequirements& needs, Allocation& out) {
    for (auto hole = block.holes.begin(); hole != block.holes.end(); ++hole) {
        const auto [start, bytes] = *hole;
        const uint64_t offset = align_up(start, needs.alignment);
        if (offset + needs.size > start + bytes) continue;
        block.holes.erase(hole);
        if (offset > start) block.holes.emplace(start, offset - start);
        const uint64_t end = offset + needs.size;
        if (end < start + bytes) block.holes.emplace(end, start + bytes - end);
        out.memory = block.memory;
        out.offset = offset;
        out.bytes = needs.size;
        out.mapped = block.mapped ? block.mapped + offset : nullptr;
        return true;
    }
    return false;
}

Result<Allocation> MemoryAllocator::allocate(const VkMemoryRequirements& needs, MemoryKind kind,
                                             bool linear, const char* what) {
    const std::lock_guard lock(mutex_);
    auto type = find_type(needs.memoryTypeBits, kind, what);
    if (!type) return type.error();
    Allocation allocation;
    // Linear and optimal resources never share a block, so bufferImageGranularity cannot matter.
    for (uint32_t index = 0; index < blocks_.size(); ++index) {
        Block& block = blocks_[index];
        if (!block.memory || block.type != *type || block.linear != linear) continue;
        if (take(block, needs, allocation)) {
            allocation.block = index;
            in_use_ += needs.size;
            return allocation;
        }
    }
    auto index = add_block(*type, std::max(kBlockBytes, needs.size), linear, what);
    if (!index) index = add_block(*type, needs.size, linear, what);
    if (!index) return index.error();
    take(blocks_[*index], needs, allocation);
    allocation.block = *index;
    in_use_ += needs.size;
    return allocation;
}

void MemoryAllocator::free(const Allocation& allocation) {
    if (!allocation.memory) return;
    const std::lock_guard lock(mutex_);
    Block& block = blocks_[allocation.block];
    in_use_ -= allocation.bytes;
    auto [hole, inserted] = block.holes.emplace(allocation.offset, allocation.bytes);
    assert(inserted);
    if (const auto next = std::next(hole);
        next != block.holes.end() && hole->first + hole->second == next->first) {
        hole->second += next->second;
        block.holes.erase(next);
    }
    if (hole != block.holes.begin()) {
        const auto previous = std::prev(hole);
        if (previous->first + previous->second == hole->first) {
            previous->second += hole->second;
            block.holes.erase(hole);
        }
    }
    const bool empty = block.holes.size() == 1 && block.holes.begin()->second == block.bytes;
    if (empty && block.bytes > kBlockBytes) {
        vkFreeMemory(device_, block.memory, nullptr);
        block = {};
    }
}

uint64_t MemoryAllocator::bytes_in_use() const {
    const std::lock_guard lock(mutex_);
    return in_use_;
}

}  // namespace vellus::gpu
