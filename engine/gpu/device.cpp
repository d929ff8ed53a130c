#include "engine/gpu/device.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cstring>
#include <optional>

#include "engine/gpu/features.h"
#include "engine/gpu/memory.h"
#include "engine/gpu/pipeline_cache.h"
#include "engine/gpu/pipeline_library.h"
#include "engine/platform/log.h"

namespace vellus::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool has_layer(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::ranges::any_of(
        layers, [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool has_instance_extension(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::ranges::any_of(extensions, [&](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance, &count, devices.data());
    return devices;
}

VkPhysicalDeviceProperties properties_of(VkPhysicalDevice physical) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    return properties;
}

int rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        default:
            return 3;
    }
}

/// One queue family that does graphics, compute and, with a surface, presentation.
std::optional<uint32_t> find_queue_family(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (uint32_t family = 0; family < count; ++family) {
        constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        if ((families[family].queueFlags & kNeeded) != kNeeded) continue;
        VkBool32 presents = VK_TRUE;
        if (surface) vkGetPhysicalDeviceSurfaceSupportKHR(physical, family, surface, &presents);
        if (presents) return family;
    }
    return std::nullopt;
}

std::string version_text(uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

DeviceTraits traits_of(VkPhysicalDevice physical) {
    VkPhysicalDeviceVulkan11Properties eleven{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES};
    VkPhysicalDeviceVulkan12Properties twelve{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES, .pNext = &eleven};
    VkPhysicalDeviceProperties2 two{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                    .pNext = &twelve};
    vkGetPhysicalDeviceProperties2(physical, &two);
    const VkPhysicalDeviceProperties& core = two.properties;
    return {.name = core.deviceName,
            .driver = fmt::format("{} {}", twelve.driverName, twelve.driverInfo),
            .api = version_text(core.apiVersion),
            .is_cpu = core.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU,
            .timestamp_period_ns = core.limits.timestampPeriod,
            .subgroup_size = eleven.subgroupSize,
            .max_image_side = core.limits.maxImageDimension2D,
            .max_buffer_bytes = eleven.maxMemoryAllocationSize};
}

}  // namespace

VkBool32 Device::on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                            VkDebugUtilsMessageTypeFlagsEXT,
                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<Device*>(user)->validation_messages_.fetch_add(1);
    const bool is_error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
    log_line(is_error ? LogLevel::kError : LogLevel::kWarning, data->pMessage);
    return VK_FALSE;
}

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
    std::unique_ptr<Device> device(new Device);
    if (auto made = device->create_instance(options); !made) return made.error();
    if (auto picked = device->pick_physical(options); !picked) return picked.error();
    if (auto made = device->create_logical(options); !made) return made.error();
    device->open_pipeline_cache(options.pipeline_cache_folder);
    device->memory_ = std::make_unique<MemoryAllocator>(device->device_, device->physical_);
    device->pipelines_ = std::make_unique<PipelineLibrary>(*device);
    return device;
}

Result<std::vector<std::string>> Device::list() {
    Device device;
    if (auto made = device.create_instance({}); !made) return made.error();
    auto devices = physical_devices(device.instance_);
    std::ranges::stable_sort(devices, {}, [](auto d) { return rank(properties_of(d).deviceType); });
    std::vector<std::string> names;
    names.reserve(devices.size());
    for (auto physical : devices) names.emplace_back(properties_of(physical).deviceName);
    return names;
}

Result<void> Device::create_instance(const DeviceOptions& options) {
    if (volkInitialize() != VK_SUCCESS) {
        return Error{"no Vulkan loader found", "libvulkan.so.1",
                     "install libvulkan1 and a driver such as mesa-vulkan-drivers"};
    }
    std::vector<const char*> layers;
    std::vector<const char*> extensions = options.instance_extensions;
    if (options.validation) {
        if (!has_layer(kValidationLayer)) {
            return Error{"validation was asked for but its layer is missing", kValidationLayer,
                         "install vulkan-validationlayers"};
        }
        layers.push_back(kValidationLayer);
    }
    has_debug_utils_ = has_instance_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (has_debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    const VkValidationFeatureEnableEXT enables[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = enables};
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "Vellus",
                                        .pEngineName = "Vellus",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = options.validation ? &features : nullptr,
        .pApplicationInfo = &application,
        .enabledLayerCount = static_cast<uint32_t>(layers.size()),
        .ppEnabledLayerNames = layers.data(),
        .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data()};
    if (const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
        result != VK_SUCCESS) {
        return vulkan_error(result, "Vulkan instance");
    }
    volkLoadInstance(instance_);

    if (options.validation && has_debug_utils_) {
        const VkDebugUtilsMessengerCreateInfoEXT messenger{
            .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
            .pfnUserCallback = on_message,
            .pUserData = this};
        vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_);
    }
    create_surface_ = options.create_surface;
    if (!create_surface_) return {};
    const VkResult result = create_surface_(instance_, &surface_);
    return result == VK_SUCCESS ? Result<void>() : vulkan_error(result, "window surface");
}

Result<void> Device::recreate_surface() {
    assert(create_surface_);
    vkDestroySurfaceKHR(instance_, surface_, nullptr);
    surface_ = VK_NULL_HANDLE;
    const VkResult result = create_surface_(instance_, &surface_);
    if (result != VK_SUCCESS) return vulkan_error(result, "window surface");
    VkBool32 can_present = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(physical_, queue_family_, surface_, &can_present);
    if (!can_present) return vulkan_error(VK_ERROR_SURFACE_LOST_KHR, "window surface");
    return {};
}

Result<void> Device::pick_physical(const DeviceOptions& options) {
    auto devices = physical_devices(instance_);
    std::ranges::stable_sort(devices, {}, [](auto d) { return rank(properties_of(d).deviceType); });
    std::string names;
    for (auto candidate : devices) {
        const std::string name = properties_of(candidate).deviceName;
        names += (names.empty() ? "" : ", ") + name;
        if (lower(name).find(lower(options.name)) == std::string::npos) continue;
        const auto family = find_queue_family(candidate, surface_);
        const auto missing = missing_features(candidate, surface_ != VK_NULL_HANDLE);
        if (family && missing.empty()) {
            physical_ = candidate;
            queue_family_ = *family;
            traits_ = traits_of(candidate);
            return {};
        }
        if (!options.name.empty() || devices.size() == 1) {
            return Error{missing.empty() ? "has no queue for graphics, compute and presentation"
                                         : "lacks " + missing,
                         name, "update the driver or pick another --device"};
        }
    }
    if (devices.empty()) {
        return Error{"no Vulkan device", "this machine",
                     "install a driver; mesa-vulkan-drivers has one for the CPU"};
    }
    return Error{fmt::format("no usable device matches; there are: {}", names), options.name,
                 "give a part of one of these names with --device"};
}

Result<void> Device::create_logical(const DeviceOptions&) {
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = queue_family_,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const RequiredFeatures features;
    const auto extensions = required_extensions(surface_ != VK_NULL_HANDLE);
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.core,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    if (const VkResult result = vkCreateDevice(physical_, &info, nullptr, &device_);
        result != VK_SUCCESS) {
        return vulkan_error(result, "device " + traits_.name);
    }
    volkLoadDevice(device_);
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                       .queueFamilyIndex = queue_family_};
    if (const VkResult result = vkCreateCommandPool(device_, &pool, nullptr, &one_shot_pool_);
        result != VK_SUCCESS) {
        return vulkan_error(result, "command pool");
    }
    return {};
}

void Device::open_pipeline_cache(const std::filesystem::path& folder) {
    if (!folder.empty()) {
        pipeline_cache_path_ = pipeline_cache_file(folder, physical_);
        loaded_cache_ = load_pipeline_cache(pipeline_cache_path_);
    }
    const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                         .initialDataSize = loaded_cache_.size(),
                                         .pInitialData = loaded_cache_.data()};
    if (vkCreatePipelineCache(device_, &info, nullptr, &pipeline_cache_) != VK_SUCCESS) {
        pipeline_cache_ = VK_NULL_HANDLE;
    }
}

void Device::close_pipeline_cache() {
    if (!pipeline_cache_path_.empty() && pipeline_cache_) {
        size_t size = 0;
        vkGetPipelineCacheData(device_, pipeline_cache_, &size, nullptr);
        std::vector<std::byte> bytes(size);
        vkGetPipelineCacheData(device_, pipeline_cache_, &size, bytes.data());
        bytes.resize(size);
        const bool changed = bytes != loaded_cache_;
        const auto kept =
            changed ? save_pipeline_cache(pipeline_cache_path_, bytes) : Result<void>();
        if (!kept) log_warning("pipeline cache not kept: {}", kept.error().message());
    }
    vkDestroyPipelineCache(device_, pipeline_cache_, nullptr);
}

Device::~Device() {
    if (device_) {
        vkDeviceWaitIdle(device_);
        pipelines_.reset();
        memory_.reset();
        close_pipeline_cache();
        vkDestroyCommandPool(device_, one_shot_pool_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (surface_) vkDestroySurfaceKHR(instance_, surface_, nullptr);
    if (messenger_) vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    if (instance_) vkDestroyInstance(instance_, nullptr);
}

void Device::set_name(VkObjectType type, uint64_t handle, const char* name) const {
    if (!has_debug_utils_) return;
    const VkDebugUtilsObjectNameInfoEXT info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name};
    vkSetDebugUtilsObjectNameEXT(device_, &info);
}

Result<void> Device::submit_now(const char* what,
                                const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBufferAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = one_shot_pool_,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    if (const VkResult result = vkAllocateCommandBuffers(device_, &allocate, &commands);
        result != VK_SUCCESS) {
        return vulkan_error(result, what);
    }
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vkBeginCommandBuffer(commands, &begin);
    record(commands);
    vkEndCommandBuffer(commands);

    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = commands};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &buffer};
    VkResult result = vkQueueSubmit2(queue_, 1, &submit, VK_NULL_HANDLE);
    if (result == VK_SUCCESS) result = vkQueueWaitIdle(queue_);
    vkFreeCommandBuffers(device_, one_shot_pool_, 1, &commands);
    if (result != VK_SUCCESS) return vulkan_error(result, what);
    return {};
}

Result<void> Device::wait_idle() {
    if (const VkResult result = vkDeviceWaitIdle(device_); result != VK_SUCCESS) {
        return vulkan_error(result, "waiting for the device");
    }
    return {};
}

}  // namespace vellus::gpu
