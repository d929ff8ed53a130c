#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/gpu/device.h"

namespace vellus::gpu {

enum class Presented : uint8_t {
    kShown,   ///< the picture is on its way to the screen
    kHidden,  ///< the window has no area now (minimised): nothing was shown, try again later
};

/// The images of a window's surface. Made anew when the window changes size, when the surface says
/// that it no longer fits, and when the surface is lost.
class Swapchain {
  public:
    /// `device` must have been created with a surface; `width` and `height` are the framebuffer's,
    /// used where the surface leaves its size to us.
    static Result<std::unique_ptr<Swapchain>> create(Device& device, uint32_t width,
                                                     uint32_t height);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// The framebuffer's size as the window reports it; 0x0 while minimised.
    void resize(uint32_t width, uint32_t height);

    /// Shows `source`, an sRGB-encoded unorm image in TRANSFER_SRC_OPTIMAL written by commands
    /// submitted before, visible to transfers. Its pixels reach the screen unchanged where its size
    /// is the window's, else stretched.
    Result<Presented> present(VkImage source, uint32_t width, uint32_t height);

    [[nodiscard]] uint32_t width() const { return extent_.width; }
    [[nodiscard]] uint32_t height() const { return extent_.height; }
    /// How often the images were made, the first time included.
    [[nodiscard]] uint32_t generation() const { return generation_; }

  private:
    static constexpr uint32_t kInFlight = 2;
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkSemaphore acquired = VK_NULL_HANDLE;
        VkFence done = VK_NULL_HANDLE;
    };

    explicit Swapchain(Device& device) : device_(device) {}
    Result<void> create_slots();
    Result<VkFormat> pick_format() const;
    /// Makes the images for the surface as it is now, and the surface itself where it was lost.
    Result<void> make();
    VkResult try_make();
    void destroy_images();
    VkResult show(const Slot& slot, uint32_t index, VkImage source, VkExtent2D size);

    Device& device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D wanted_{};
    VkExtent2D extent_{};
    bool stale_ = true;
    uint32_t generation_ = 0;
    uint32_t next_slot_ = 0;
    std::array<Slot, kInFlight> slots_{};
    std::vector<VkImage> images_;
    std::vector<VkSemaphore> rendered_;  ///< one per image
};

}  // namespace vellus::gpu
