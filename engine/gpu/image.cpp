#include "engine/gpu/image.h"

#include <algorithm>

#include "engine/gpu/buffer.h"

namespace vellus::gpu {

namespace {

VkImageAspectFlags aspect_of(Format format) {
    return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

}  // namespace

VkImageUsageFlags usable_as(Device& device, Format format) {
    VkFormatProperties3 three{.sType = VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3};
    VkFormatProperties2 two{.sType = VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2, .pNext = &three};
    vkGetPhysicalDeviceFormatProperties2(device.physical(), to_vulkan(format), &two);
    const VkFormatFeatureFlags2 can = three.optimalTilingFeatures;
    VkImageUsageFlags usage = 0;
    const auto allow = [&](VkFormatFeatureFlags2 feature, VkImageUsageFlags bit) {
        if (can & feature) usage |= bit;
    };
    allow(VK_FORMAT_FEATURE_2_TRANSFER_SRC_BIT, VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    allow(VK_FORMAT_FEATURE_2_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    allow(VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_BIT, VK_IMAGE_USAGE_SAMPLED_BIT);
    allow(VK_FORMAT_FEATURE_2_STORAGE_IMAGE_BIT, VK_IMAGE_USAGE_STORAGE_BIT);
    allow(VK_FORMAT_FEATURE_2_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    allow(VK_FORMAT_FEATURE_2_DEPTH_STENCIL_ATTACHMENT_BIT,
          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    return usage;
}

VkImageCreateInfo image_create_info(Device& device, const ImageInfo& info) {
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
            .imageType = VK_IMAGE_TYPE_2D,
            .format = to_vulkan(info.format),
            .extent = {info.width, info.height, 1},
            .mipLevels = info.mips,
            .arrayLayers = info.layers,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .tiling = VK_IMAGE_TILING_OPTIMAL,
            .usage = usable_as(device, info.format),
            .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
}

Result<VkImageView> create_view(Device& device, VkImage image, const ImageInfo& info,
                                const char* name) {
    const VkImageViewCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image,
        .viewType = info.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
        .format = to_vulkan(info.format),
        .subresourceRange = {aspect_of(info.format), 0, info.mips, 0, info.layers}};
    VkImageView view = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateImageView(device.handle(), &create, nullptr, &view);
        result != VK_SUCCESS) {
        return vulkan_error(result, name);
    }
    device.set_name(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<uint64_t>(view), name);
    return view;
}

Result<Image> Image::create(Device& device, const ImageInfo& info, const char* name) {
    const uint32_t limit = device.traits().max_image_side;
    if (info.width == 0 || info.height == 0 || info.width > limit || info.height > limit) {
        return Error{
            fmt::format("size {}x{} is not within 1 to {}", info.width, info.height, limit), name,
            "choose another --size"};
    }
    Image image;
    image.device_ = &device;
    image.info_ = info;
    const VkImageCreateInfo create = image_create_info(device, info);
    if (const VkResult result = vkCreateImage(device.handle(), &create, nullptr, &image.image_);
        result != VK_SUCCESS) {
        return vulkan_error(result, name);
    }
    device.set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image.image_), name);
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle(), image.image_, &needs);
    auto allocation = device.memory().allocate(needs, MemoryKind::kDevice, false, name);
    if (!allocation) return allocation.error();
    image.allocation_ = *allocation;
    if (const VkResult result = vkBindImageMemory(device.handle(), image.image_, allocation->memory,
                                                  allocation->offset);
        result != VK_SUCCESS) {
        return vulkan_error(result, name);
    }
    auto view = create_view(device, image.image_, info, name);
    if (!view) return view.error();
    image.view_ = *view;
    return image;
}

Result<Image> Image::upload(Device& device, const ImageInfo& info,
                            std::span<const std::byte> pixels, const char* name) {
    assert(pixels.size() == uint64_t{info.width} * info.height * bytes_per_pixel(info.format));
    auto image = create(device, info, name);
    if (!image) return image;
    auto staging = Buffer::create(device, pixels.size(), MemoryKind::kUpload, name);
    if (!staging) return staging.error();
    staging->write(pixels);
    auto copied = device.submit_now(name, [&](VkCommandBuffer commands) {
        transition(commands, image->handle(), info.format, VK_IMAGE_LAYOUT_UNDEFINED,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {aspect_of(info.format), 0, 0, 1},
                                       .imageExtent = {info.width, info.height, 1}};
        vkCmdCopyBufferToImage(commands, staging->handle(), image->handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        transition(commands, image->handle(), info.format, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    if (!copied) return copied.error();
    return image;
}

Image::~Image() {
    if (!device_) return;
    vkDestroyImageView(device_->handle(), view_, nullptr);
    vkDestroyImage(device_->handle(), image_, nullptr);
    device_->memory().free(allocation_);
}

void transition(VkCommandBuffer commands, VkImage image, Format format, VkImageLayout from,
                VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier{
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_MEMORY_READ_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {aspect_of(format), 0, VK_REMAINING_MIP_LEVELS, 0,
                             VK_REMAINING_ARRAY_LAYERS}};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount = 1,
                                      .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace vellus::gpu
