#include "engine/gpu/swapchain.h"

#include <algorithm>
#include <limits>

namespace vellus::gpu {

namespace {

// The pictures are sRGB-encoded already, so the surface must store bytes as they come.
constexpr VkFormat kFormats[] = {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM,
                                 VK_FORMAT_A2B10G10R10_UNORM_PACK32,
                                 VK_FORMAT_A2R10G10B10_UNORM_PACK32};
constexpr uint64_t kSecond = 1'000'000'000;

bool can_blit_to(VkPhysicalDevice physical, VkFormat format) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_BLIT_DST_BIT) != 0;
}

VkPresentModeKHR pick_mode(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfacePresentModesKHR(physical, surface, &count, nullptr);
    std::vector<VkPresentModeKHR> modes(count);
    vkGetPhysicalDeviceSurfacePresentModesKHR(physical, surface, &count, modes.data());
    const bool mailbox = std::ranges::find(modes, VK_PRESENT_MODE_MAILBOX_KHR) != modes.end();
    return mailbox ? VK_PRESENT_MODE_MAILBOX_KHR : VK_PRESENT_MODE_FIFO_KHR;
}

VkExtent2D pick_extent(const VkSurfaceCapabilitiesKHR& can, VkExtent2D wanted) {
    if (can.currentExtent.width != std::numeric_limits<uint32_t>::max()) return can.currentExtent;
    if (wanted.width == 0 || wanted.height == 0) return {0, 0};
    return {std::clamp(wanted.width, can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(wanted.height, can.minImageExtent.height, can.maxImageExtent.height)};
}

uint32_t pick_count(const VkSurfaceCapabilitiesKHR& can) {
    const uint32_t wanted = std::max(3u, can.minImageCount + 1);
    return can.maxImageCount == 0 ? wanted : std::min(wanted, can.maxImageCount);
}

VkCompositeAlphaFlagBitsKHR pick_alpha(const VkSurfaceCapabilitiesKHR& can) {
    for (const VkCompositeAlphaFlagBitsKHR alpha :
         {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
          VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR}) {
        if (can.supportedCompositeAlpha & alpha) return alpha;
    }
    return VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR;
}

VkImageMemoryBarrier2 barrier(VkImage image, VkImageLayout from, VkImageLayout to,
                              VkAccessFlags2 before, VkAccessFlags2 after) {
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
            .srcAccessMask = before,
            .dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
            .dstAccessMask = after,
            .oldLayout = from,
            .newLayout = to,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
}

void record_barrier(VkCommandBuffer commands, const VkImageMemoryBarrier2& image) {
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount = 1,
                                      .pImageMemoryBarriers = &image};
    vkCmdPipelineBarrier2(commands, &dependency);
}

void record_blit(VkCommandBuffer commands, VkImage source, VkExtent2D from, VkImage target,
                 VkExtent2D to) {
    const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const auto corner = [](VkExtent2D size) {
        return VkOffset3D{static_cast<int32_t>(size.width), static_cast<int32_t>(size.height), 1};
    };
    const VkImageBlit region{.srcSubresource = layers,
                             .srcOffsets = {{}, corner(from)},
                             .dstSubresource = layers,
                             .dstOffsets = {{}, corner(to)}};
    vkCmdBlitImage(commands, source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
}

/// The surface no longer fits, but can be served again by new images.
bool is_stale(VkResult result) {
    return result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR ||
           result == VK_ERROR_SURFACE_LOST_KHR;
}

}  // namespace

Result<std::unique_ptr<Swapchain>> Swapchain::create(Device& device, uint32_t width,
                                                     uint32_t height) {
    std::unique_ptr<Swapchain> swapchain(new Swapchain(device));
    swapchain->wanted_ = {width, height};
    if (auto made = swapchain->create_slots(); !made) return made.error();
    if (auto made = swapchain->make(); !made) return made.error();
    return swapchain;
}

Swapchain::~Swapchain() {
    vkQueueWaitIdle(device_.queue());
    destroy_images();
    for (const Slot& slot : slots_) {
        vkDestroySemaphore(device_.handle(), slot.acquired, nullptr);
        vkDestroyFence(device_.handle(), slot.done, nullptr);
    }
    vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

Result<void> Swapchain::create_slots() {
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                       .queueFamilyIndex = device_.queue_family()};
    VkResult result = vkCreateCommandPool(device_.handle(), &pool, nullptr, &pool_);
    if (result != VK_SUCCESS) return vulkan_error(result, "swapchain");
    for (Slot& slot : slots_) {
        const VkCommandBufferAllocateInfo allocate{
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .commandPool = pool_,
            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
            .commandBufferCount = 1};
        const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                      .flags = VK_FENCE_CREATE_SIGNALED_BIT};
        result = vkAllocateCommandBuffers(device_.handle(), &allocate, &slot.commands);
        if (result == VK_SUCCESS) {
            result = vkCreateSemaphore(device_.handle(), &semaphore, nullptr, &slot.acquired);
        }
        if (result == VK_SUCCESS) {
            result = vkCreateFence(device_.handle(), &fence, nullptr, &slot.done);
        }
        if (result != VK_SUCCESS) return vulkan_error(result, "swapchain");
    }
    return {};
}

void Swapchain::resize(uint32_t width, uint32_t height) {
    if (wanted_.width == width && wanted_.height == height) return;
    wanted_ = {width, height};
    stale_ = true;
}

Result<VkFormat> Swapchain::pick_format() const {
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), device_.surface(), &count, nullptr);
    std::vector<VkSurfaceFormatKHR> offered(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), device_.surface(), &count,
                                         offered.data());
    for (const VkFormat format : kFormats) {
        const bool fits = std::ranges::any_of(offered, [&](const VkSurfaceFormatKHR& offer) {
            return offer.format == format && offer.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
        });
        if (fits && can_blit_to(device_.physical(), format)) return format;
    }
    return Error{"offers no format that stores sRGB-encoded bytes", "window surface",
                 "pick another --device, or add --headless"};
}

Result<void> Swapchain::make() {
    // A lost surface is replaced once; a second loss in a row is the window system's last word.
    for (bool second_try : {false, true}) {
        const VkResult result = try_make();
        if (result == VK_SUCCESS) return {};
        if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) return pick_format().error();
        if (result != VK_ERROR_SURFACE_LOST_KHR || second_try) {
            return vulkan_error(result, "swapchain");
        }
        vkQueueWaitIdle(device_.queue());
        destroy_images();
        if (auto made = device_.recreate_surface(); !made) return made;
    }
    return {};
}

VkResult Swapchain::try_make() {
    extent_ = {0, 0};
    if (wanted_.width == 0 || wanted_.height == 0) return VK_SUCCESS;
    VkSurfaceCapabilitiesKHR can;
    VkResult result =
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), device_.surface(), &can);
    if (result != VK_SUCCESS) return result;
    const VkExtent2D extent = pick_extent(can, wanted_);
    if (extent.width == 0 || extent.height == 0) return VK_SUCCESS;
    const auto format = pick_format();
    if (!format) return VK_ERROR_FORMAT_NOT_SUPPORTED;

    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = device_.surface(),
        .minImageCount = pick_count(can),
        .imageFormat = *format,
        .imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR,
        .imageExtent = extent,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .preTransform = can.currentTransform,
        .compositeAlpha = pick_alpha(can),
        .presentMode = pick_mode(device_.physical(), device_.surface()),
        .clipped = VK_TRUE,
        .oldSwapchain = swapchain_};
    VkSwapchainKHR made = VK_NULL_HANDLE;
    result = vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &made);
    vkQueueWaitIdle(device_.queue());
    destroy_images();
    if (result != VK_SUCCESS) return result;
    swapchain_ = made;
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr);
    images_.resize(count);
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images_.data());
    rendered_.resize(count);
    for (VkSemaphore& semaphore : rendered_) {
        const VkSemaphoreCreateInfo create{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        result = vkCreateSemaphore(device_.handle(), &create, nullptr, &semaphore);
        if (result != VK_SUCCESS) return result;
    }
    extent_ = extent;
    stale_ = false;
    ++generation_;
    return VK_SUCCESS;
}

void Swapchain::destroy_images() {
    for (VkSemaphore semaphore : rendered_) {
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    }
    rendered_.clear();
    images_.clear();
    vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = VK_NULL_HANDLE;
    extent_ = {0, 0};
    stale_ = true;
}

Result<Presented> Swapchain::present(VkImage source, uint32_t width, uint32_t height) {
    // While the user drags the window's edge, new images can be out of date before their first use.
    constexpr int kAttempts = 4;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        if (stale_) {
            if (auto made = make(); !made) return made.error();
        }
        if (extent_.width == 0) return Presented::kHidden;
        const Slot& slot = slots_[next_slot_];
        vkWaitForFences(device_.handle(), 1, &slot.done, VK_TRUE,
                        std::numeric_limits<uint64_t>::max());
        uint32_t index = 0;
        VkResult result = vkAcquireNextImageKHR(device_.handle(), swapchain_, kSecond,
                                                slot.acquired, VK_NULL_HANDLE, &index);
        // A hidden window may give no image back; the caller goes on handling events.
        if (result == VK_TIMEOUT || result == VK_NOT_READY) return Presented::kHidden;
        if (is_stale(result)) stale_ = true;
        if (result != VK_SUCCESS && result != VK_SUBOPTIMAL_KHR) {
            if (stale_) continue;
            return vulkan_error(result, "swapchain");
        }
        result = show(slot, index, source, {width, height});
        next_slot_ = (next_slot_ + 1) % kInFlight;
        if (result == VK_SUCCESS) return Presented::kShown;
        if (!is_stale(result)) return vulkan_error(result, "swapchain");
        stale_ = true;
        if (result == VK_SUBOPTIMAL_KHR) return Presented::kShown;
    }
    return Presented::kHidden;
}

VkResult Swapchain::show(const Slot& slot, uint32_t index, VkImage source, VkExtent2D size) {
    vkResetFences(device_.handle(), 1, &slot.done);
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    VkImage target = images_[index];
    vkBeginCommandBuffer(slot.commands, &begin);
    record_barrier(slot.commands,
                   barrier(target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           VK_ACCESS_2_NONE, VK_ACCESS_2_TRANSFER_WRITE_BIT));
    record_blit(slot.commands, source, size, target, extent_);
    record_barrier(slot.commands, barrier(target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                          VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                                          VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_ACCESS_2_NONE));
    vkEndCommandBuffer(slot.commands);

    const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = slot.acquired,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT};
    const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = rendered_[index],
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT};
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = slot.commands};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .waitSemaphoreInfoCount = 1,
                               .pWaitSemaphoreInfos = &wait,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &buffer,
                               .signalSemaphoreInfoCount = 1,
                               .pSignalSemaphoreInfos = &signal};
    const VkResult submitted = vkQueueSubmit2(device_.queue(), 1, &submit, slot.done);
    if (submitted != VK_SUCCESS) return submitted;
    const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                   .waitSemaphoreCount = 1,
                                   .pWaitSemaphores = &rendered_[index],
                                   .swapchainCount = 1,
                                   .pSwapchains = &swapchain_,
                                   .pImageIndices = &index};
    return vkQueuePresentKHR(device_.queue(), &present);
}

}  // namespace vellus::gpu
