#include "engine/frame_graph/physical.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "engine/platform/hash.h"

namespace vellus::graph {

namespace {

/// Frames a resource may go unused before its memory is given up.
constexpr uint64_t kPatience = 30;

VkImageCreateInfo image_info(const ImageDesc& desc, uint32_t usage) {
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
            .imageType = VK_IMAGE_TYPE_2D,
            .format = gpu::to_vulkan(desc.format),
            .extent = {desc.width, desc.height, 1},
            .mipLevels = desc.mips,
            .arrayLayers = desc.layers,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .tiling = VK_IMAGE_TILING_OPTIMAL,
            .usage = usage,
            .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
}

VkBufferCreateInfo buffer_info(uint64_t bytes, uint32_t usage) {
    return {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
            .size = bytes,
            .usage = usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
            .sharingMode = VK_SHARING_MODE_EXCLUSIVE};
}

/// The error of a pool, with the resource that asks for most of it.
Error with_largest(Error error, const GraphDescription& graph, const Plan& plan, const Pool& pool) {
    const auto index = static_cast<uint32_t>(&pool - plan.pools.data());
    const Placement* largest = nullptr;
    for (const Placement& placement : plan.placements) {
        if (placement.pool != index) continue;
        if (!largest || placement.bytes > largest->bytes) largest = &placement;
    }
    if (!largest) return error;
    const ResourceRecord& resource = graph.resources()[largest - plan.placements.data()];
    error.where += fmt::format(", of which '{}' needs {:.1f} MiB", resource.name,
                               static_cast<double>(largest->bytes) / (1 << 20));
    return error;
}

}  // namespace

void Graveyard::expect() {
    if (++expected_ <= std::min(graves_.capacity(), images_.capacity())) return;
    graves_.reserve(expected_ * 2);
    images_.reserve(expected_ * 2);
}

void Graveyard::bury(uint64_t done) {
    expected_ -= std::erase_if(graves_, [&](const Grave& grave) {
        if (grave.frame > done) return false;
        vkDestroyImageView(device_.handle(), grave.view, nullptr);
        vkDestroyImage(device_.handle(), grave.image, nullptr);
        vkDestroyBuffer(device_.handle(), grave.buffer, nullptr);
        device_.memory().free(grave.memory);
        return true;
    });
    expected_ -= std::erase_if(images_, [&](const OldImage& old) { return old.frame <= done; });
}

Result<VkImageView> view_of(gpu::Device& device, const ImageDesc& desc, VkImage image,
                            const ImageRange& range, std::vector<ViewOfRange>& views,
                            Graveyard& graveyard, uint64_t& created) {
    for (const ViewOfRange& view : views) {
        if (view.range == range) return view.view;
    }
    const VkImageAspectFlags aspect =
        gpu::is_depth(desc.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image,
        .viewType = range.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
        .format = gpu::to_vulkan(desc.format),
        .subresourceRange = {aspect, range.mip, range.mips, range.layer, range.layers}};
    VkImageView view = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateImageView(device.handle(), &info, nullptr, &view);
        result != VK_SUCCESS) {
        return gpu::vulkan_error(result, "view of a frame graph image");
    }
    ++created;
    graveyard.expect();
    views.push_back({range, view});
    return view;
}

size_t TransientHeap::KeyHash::operator()(const Key& key) const {
    const std::array<uint64_t, 6> words = {
        static_cast<uint64_t>(key.image.format) | uint64_t{key.usage} << 32,
        key.image.width | uint64_t{key.image.height} << 32,
        key.image.layers | uint64_t{key.image.mips} << 32,
        key.bytes,
        key.block,
        key.offset};
    return fnv1a(std::as_bytes(std::span(words)));
}

TransientHeap::~TransientHeap() {
    for (Block& block : blocks_) retire_block(block);
}

MemoryNeeds TransientHeap::needs(const ResourceRecord& resource, uint32_t usage) {
    const bool image = resource.kind == ResourceKind::kImage;
    const Key key{.image = resource.image, .bytes = resource.buffer.bytes, .usage = usage};
    if (const auto known = needs_.find(key); known != needs_.end()) return known->second;
    VkMemoryRequirements2 found{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    if (image) {
        const VkImageCreateInfo info = image_info(resource.image, usage);
        const VkDeviceImageMemoryRequirements question{
            .sType = VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS, .pCreateInfo = &info};
        vkGetDeviceImageMemoryRequirements(device_.handle(), &question, &found);
    } else {
        const VkBufferCreateInfo info = buffer_info(resource.buffer.bytes, usage);
        const VkDeviceBufferMemoryRequirements question{
            .sType = VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS, .pCreateInfo = &info};
        vkGetDeviceBufferMemoryRequirements(device_.handle(), &question, &found);
    }
    const VkMemoryRequirements& n = found.memoryRequirements;
    return needs_[key] = {n.size, n.alignment, n.memoryTypeBits};
}

Result<TransientHeap::Block*> TransientHeap::block_for(const Pool& pool, uint64_t frame) {
    auto block = std::ranges::find_if(blocks_, [&](const Block& b) {
        return b.kind == pool.kind && b.type_bits == pool.type_bits;
    });
    if (block == blocks_.end()) {
        blocks_.push_back({.kind = pool.kind, .type_bits = pool.type_bits});
        block = blocks_.end() - 1;
    }
    const bool fits = block->memory.memory && block->memory.bytes >= pool.bytes &&
                      block->memory.offset % pool.alignment == 0;
    if (fits) {
        if (pool.bytes * 2 > block->memory.bytes) block->last_fit = frame;
        if (frame <= block->last_fit + kPatience) return &*block;
    }
    retire_block(*block);
    const bool linear = pool.kind == ResourceKind::kBuffer;
    auto memory = device_.memory().allocate({pool.bytes, pool.alignment, pool.type_bits},
                                            gpu::MemoryKind::kDevice, linear,
                                            linear ? "transient buffers" : "transient images");
    if (!memory) return memory.error();
    block->memory = *memory;
    block->id = next_id_++;
    block->last_fit = frame;
    ++created_;
    graveyard_.expect();
    return &*block;
}

Result<TransientHeap::Placed> TransientHeap::make(const ResourceRecord& resource,
                                                  const Placement& placement, const Block& block) {
    Placed placed;
    const std::string name(resource.name);
    const VkDevice device = device_.handle();
    const uint64_t offset = block.memory.offset + placement.offset;
    ++created_;
    if (resource.kind == ResourceKind::kImage) {
        const VkImageCreateInfo info = image_info(resource.image, placement.usage);
        VkResult result = vkCreateImage(device, &info, nullptr, &placed.image);
        if (result == VK_SUCCESS) {
            result = vkBindImageMemory(device, placed.image, block.memory.memory, offset);
        }
        if (result != VK_SUCCESS) {
            vkDestroyImage(device, placed.image, nullptr);
            return gpu::vulkan_error(result, name);
        }
        device_.set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(placed.image),
                         name.c_str());
        return placed;
    }
    const VkBufferCreateInfo info = buffer_info(resource.buffer.bytes, placement.usage);
    VkResult result = vkCreateBuffer(device, &info, nullptr, &placed.buffer);
    if (result == VK_SUCCESS) {
        result = vkBindBufferMemory(device, placed.buffer, block.memory.memory, offset);
    }
    if (result != VK_SUCCESS) {
        vkDestroyBuffer(device, placed.buffer, nullptr);
        return gpu::vulkan_error(result, name);
    }
    device_.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(placed.buffer),
                     name.c_str());
    const VkBufferDeviceAddressInfo where{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                          .buffer = placed.buffer};
    placed.address = vkGetBufferDeviceAddress(device, &where);
    return placed;
}

Result<void> TransientHeap::bind(const GraphDescription& graph, const Plan& plan, uint64_t frame,
                                 std::vector<Physical>& physical) {
    blocks_.reserve(blocks_.size() + plan.pools.size());  // block_for() hands out pointers
    pool_blocks_.clear();
    for (const Pool& pool : plan.pools) {
        auto block = block_for(pool, frame);
        if (!block) return with_largest(block.error(), graph, plan, pool);
        pool_blocks_.push_back(*block);
    }
    for (uint32_t i = 0; i < plan.placements.size(); ++i) {
        const Placement& placement = plan.placements[i];
        if (placement.pool == kNoIndex) continue;
        const ResourceRecord& resource = graph.resources()[i];
        const Block& block = *pool_blocks_[placement.pool];
        const Key key{.image = resource.image,
                      .bytes = resource.buffer.bytes,
                      .usage = placement.usage,
                      .block = block.id,
                      .offset = placement.offset};
        auto found = placed_.find(key);
        if (found == placed_.end()) {
            auto placed = make(resource, placement, block);
            if (!placed) return placed.error();
            graveyard_.expect();
            found = placed_.emplace(key, std::move(*placed)).first;
        }
        Placed& placed = found->second;
        placed.last_frame = frame;
        physical[i].image = placed.image;
        physical[i].buffer = placed.buffer;
        physical[i].address = placed.address;
        physical[i].views = &placed.views;
    }
    return {};
}

void TransientHeap::retire(const Placed& placed) {
    for (const ViewOfRange& view : placed.views) {
        graveyard_.add({.frame = placed.last_frame, .view = view.view});
    }
    graveyard_.add({.frame = placed.last_frame, .image = placed.image, .buffer = placed.buffer});
}

void TransientHeap::retire_block(Block& block) {
    if (!block.memory.memory) return;
    uint64_t last = 0;
    std::erase_if(placed_, [&](const auto& entry) {
        if (entry.first.block != block.id) return false;
        last = std::max(last, entry.second.last_frame);
        retire(entry.second);
        return true;
    });
    graveyard_.add({.frame = last, .memory = block.memory});
    block.memory = {};
}

void TransientHeap::trim(uint64_t frame) {
    std::erase_if(placed_, [&](const auto& entry) {
        if (entry.second.last_frame + kPatience >= frame) return false;
        retire(entry.second);
        return true;
    });
    for (Block& block : blocks_) {
        const bool used = std::ranges::any_of(
            placed_, [&](const auto& entry) { return entry.first.block == block.id; });
        if (!used) retire_block(block);
    }
}

uint64_t TransientHeap::bytes_held() const {
    uint64_t bytes = 0;
    for (const Block& block : blocks_) bytes += block.memory.bytes;
    return bytes;
}

}  // namespace vellus::graph
