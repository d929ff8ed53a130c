#include "engine/gpu/buffer.h"

#include <algorithm>

namespace vellus::gpu {

Result<Buffer> Buffer::create(Device& device, uint64_t bytes, MemoryKind kind, const char* name) {
    Buffer buffer;
    buffer.device_ = &device;
    buffer.bytes_ = std::max<uint64_t>(bytes, 16);
    constexpr VkBufferUsageFlags kEverything =
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
        VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .size = buffer.bytes_,
                                  .usage = kEverything,
                                  .sharingMode = VK_SHARING_MODE_EXCLUSIVE};
    if (buffer.bytes_ > device.traits().max_buffer_bytes) {
        return Error{fmt::format("needs {} bytes; the device allows {}", buffer.bytes_,
                                 device.traits().max_buffer_bytes),
                     name, "use fewer strands or a smaller picture"};
    }
    if (const VkResult result = vkCreateBuffer(device.handle(), &info, nullptr, &buffer.buffer_);
        result != VK_SUCCESS) {
        return vulkan_error(result, name);
    }
    device.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer.buffer_), name);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle(), buffer.buffer_, &needs);
    auto allocation = device.memory().allocate(needs, kind, true, name);
    if (!allocation) return allocation.error();
    buffer.allocation_ = *allocation;
    if (const VkResult result = vkBindBufferMemory(device.handle(), buffer.buffer_,
                                                   allocation->memory, allocation->offset);
        result != VK_SUCCESS) {
        return vulkan_error(result, name);
    }
    const VkBufferDeviceAddressInfo address{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                            .buffer = buffer.buffer_};
    buffer.address_ = vkGetBufferDeviceAddress(device.handle(), &address);
    return buffer;
}

Result<Buffer> Buffer::upload(Device& device, std::span<const std::byte> contents,
                              const char* name) {
    auto target = create(device, contents.size(), MemoryKind::kDevice, name);
    if (!target || contents.empty()) return target;
    if (std::byte* mapped = target->mapped()) {
        std::memcpy(mapped, contents.data(), contents.size());
        return target;
    }
    auto staging = create(device, contents.size(), MemoryKind::kUpload, name);
    if (!staging) return staging.error();
    staging->write(contents);
    auto copied = device.submit_now(name, [&](VkCommandBuffer commands) {
        const VkBufferCopy region{.size = contents.size()};
        vkCmdCopyBuffer(commands, staging->handle(), target->handle(), 1, &region);
    });
    if (!copied) return copied.error();
    return target;
}

Result<void> Buffer::read_back(Device& device, std::span<std::byte> out) const {
    assert(out.size() <= bytes_);
    auto staging = create(device, out.size(), MemoryKind::kReadback, "readback");
    if (!staging) return staging.error();
    auto copied = device.submit_now("readback", [&](VkCommandBuffer commands) {
        const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                       .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                       .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                       .dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT};
        const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                          .memoryBarrierCount = 1,
                                          .pMemoryBarriers = &barrier};
        vkCmdPipelineBarrier2(commands, &dependency);
        const VkBufferCopy region{.size = out.size()};
        vkCmdCopyBuffer(commands, buffer_, staging->handle(), 1, &region);
    });
    if (!copied) return copied.error();
    std::memcpy(out.data(), staging->mapped(), out.size());
    return {};
}

Buffer::~Buffer() {
    if (!device_) return;
    vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    device_->memory().free(allocation_);
}

}  // namespace vellus::gpu
