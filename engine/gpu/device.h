#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/vulkan.h"

namespace vellus::gpu {

class MemoryAllocator;
class PipelineLibrary;

struct DeviceOptions {
    /// Part of the device's name, any case; empty takes the fastest kind there is.
    std::string name;
    /// Validation and synchronization validation; every message is logged and counted.
    bool validation = false;
    /// Folder of the pipeline cache, one file per device and driver; empty keeps none.
    std::filesystem::path pipeline_cache_folder;
    /// Extensions that the window system asks for; empty means headless.
    std::vector<const char*> instance_extensions;
    /// Makes the surface that presentation must support; unset means headless.
    std::function<VkResult(VkInstance, VkSurfaceKHR*)> create_surface;
};

/// What a device promises to the code above it.
struct DeviceTraits {
    std::string name;
    std::string driver;
    std::string api;
    bool is_cpu = false;
    float timestamp_period_ns = 1.0f;
    uint32_t subgroup_size = 1;
    uint32_t max_image_side = 0;
    uint64_t max_buffer_bytes = 0;
};

/// A Vulkan 1.3 device with one queue for everything, its memory and its pipelines.
class Device {
  public:
    /// Errors name the missing loader, device or feature.
    static Result<std::unique_ptr<Device>> create(const DeviceOptions& options);
    /// Names of all usable devices, in order of preference.
    static Result<std::vector<std::string>> list();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queue_family() const { return queue_family_; }
    [[nodiscard]] VkSurfaceKHR surface() const { return surface_; }
    /// After VK_ERROR_SURFACE_LOST_KHR: a new surface in place of the old; no swapchain may use it.
    Result<void> recreate_surface();
    [[nodiscard]] const DeviceTraits& traits() const { return traits_; }
    [[nodiscard]] MemoryAllocator& memory() { return *memory_; }
    [[nodiscard]] PipelineLibrary& pipelines() { return *pipelines_; }
    [[nodiscard]] VkPipelineCache pipeline_cache() const { return pipeline_cache_; }
    /// Bytes of pipelines found on disk from earlier runs.
    [[nodiscard]] size_t pipeline_cache_loaded() const { return loaded_cache_.size(); }
    /// Number of validation messages so far; stays 0 in a correct program.
    [[nodiscard]] uint32_t validation_messages() const { return validation_messages_; }

    /// Gives a Vulkan object the name shown by validation and capture tools.
    void set_name(VkObjectType type, uint64_t handle, const char* name) const;
    /// Records, submits and waits: for uploads and readbacks outside the frame.
    Result<void> submit_now(const char* what, const std::function<void(VkCommandBuffer)>& record);
    /// Waits until the device has nothing left to do.
    Result<void> wait_idle();

  private:
    Device() = default;
    Result<void> create_instance(const DeviceOptions& options);
    Result<void> pick_physical(const DeviceOptions& options);
    Result<void> create_logical(const DeviceOptions& options);
    void open_pipeline_cache(const std::filesystem::path& folder);
    void close_pipeline_cache();
    static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(
        VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT type,
        const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    std::function<VkResult(VkInstance, VkSurfaceKHR*)> create_surface_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queue_family_ = 0;
    VkCommandPool one_shot_pool_ = VK_NULL_HANDLE;
    VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
    std::filesystem::path pipeline_cache_path_;
    std::vector<std::byte> loaded_cache_;
    DeviceTraits traits_;
    bool has_debug_utils_ = false;
    std::atomic<uint32_t> validation_messages_ = 0;
    std::unique_ptr<MemoryAllocator> memory_;
    std::unique_ptr<PipelineLibrary> pipelines_;
};

}  // namespace vellus::gpu
