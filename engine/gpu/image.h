#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/gpu/memory.h"

namespace vellus::gpu {

struct ImageInfo {
    Format format = Format::kRgba8Unorm;
    uint32_t width = 1;
    uint32_t height = 1;
    uint32_t layers = 1;
    uint32_t mips = 1;
};

/// Every usage the format allows on this device, of those the engine knows.
VkImageUsageFlags usable_as(Device& device, Format format);
/// The description Vulkan wants, with every usage the format allows.
VkImageCreateInfo image_create_info(Device& device, const ImageInfo& info);
/// A view of the whole image.
Result<VkImageView> create_view(Device& device, VkImage image, const ImageInfo& info,
                                const char* name);

/// An image that lives across frames, with a view of all of it; owns its memory.
class Image {
  public:
    Image() = default;
    static Result<Image> create(Device& device, const ImageInfo& info, const char* name);
    /// An image holding `pixels` (tightly packed, mip 0, layer 0), ready to be sampled.
    static Result<Image> upload(Device& device, const ImageInfo& info,
                                std::span<const std::byte> pixels, const char* name);
    ~Image();
    Image(Image&& other) noexcept { swap(other); }
    Image& operator=(Image&& other) noexcept {
        swap(other);
        return *this;
    }

    [[nodiscard]] VkImage handle() const { return image_; }
    [[nodiscard]] VkImageView view() const { return view_; }
    [[nodiscard]] const ImageInfo& info() const { return info_; }
    [[nodiscard]] uint64_t bytes() const { return allocation_.bytes; }
    explicit operator bool() const { return image_ != VK_NULL_HANDLE; }

  private:
    void swap(Image& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(image_, other.image_);
        std::swap(view_, other.view_);
        std::swap(info_, other.info_);
        std::swap(allocation_, other.allocation_);
    }

    Device* device_ = nullptr;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    ImageInfo info_;
    Allocation allocation_;
};

/// Moves a whole image between layouts with a full barrier: for uploads and tests, not for frames.
void transition(VkCommandBuffer commands, VkImage image, Format format, VkImageLayout from,
                VkImageLayout to);

}  // namespace vellus::gpu
