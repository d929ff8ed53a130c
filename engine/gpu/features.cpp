#include "engine/gpu/features.h"

#include <algorithm>
#include <cstring>

namespace vellus::gpu {

namespace {

struct NamedFeature {
    const char* name;
    VkBool32 (*present)(const RequiredFeatures&);
};

// One row per feature the engine uses: the same list is asked of the device and switched on.
#define VELLUS_FEATURE(block, member)                                     \
    NamedFeature {                                                        \
#member, [](const RequiredFeatures& f) { return f.block.member; } \
    }
constexpr NamedFeature kFeatures[] = {
    VELLUS_FEATURE(core.features, shaderInt64), VELLUS_FEATURE(twelve, bufferDeviceAddress),
    VELLUS_FEATURE(twelve, scalarBlockLayout),  VELLUS_FEATURE(twelve, shaderBufferInt64Atomics),
    VELLUS_FEATURE(twelve, timelineSemaphore),  VELLUS_FEATURE(thirteen, synchronization2),
    VELLUS_FEATURE(thirteen, dynamicRendering), VELLUS_FEATURE(thirteen, maintenance4),
};
#undef VELLUS_FEATURE

}  // namespace

RequiredFeatures::RequiredFeatures()
    : core{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &eleven, .features = {}},
      eleven{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, .pNext = &twelve},
      twelve{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &thirteen},
      thirteen{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES} {
    core.features.shaderInt64 = VK_TRUE;
    twelve.bufferDeviceAddress = VK_TRUE;
    twelve.scalarBlockLayout = VK_TRUE;
    twelve.shaderBufferInt64Atomics = VK_TRUE;
    twelve.timelineSemaphore = VK_TRUE;
    thirteen.synchronization2 = VK_TRUE;
    thirteen.dynamicRendering = VK_TRUE;
    thirteen.maintenance4 = VK_TRUE;
}

std::vector<const char*> required_extensions(bool windowed) {
    std::vector<const char*> names = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
    if (windowed) names.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    return names;
}

std::string missing_features(VkPhysicalDevice physical, bool windowed) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3) return "Vulkan 1.3";

    RequiredFeatures present;
    vkGetPhysicalDeviceFeatures2(physical, &present.core);
    std::string missing;
    const auto add = [&](const char* name) {
        missing += (missing.empty() ? "" : ", ") + std::string(name);
    };
    for (const NamedFeature& feature : kFeatures) {
        if (!feature.present(present)) add(feature.name);
    }
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    for (const char* name : required_extensions(windowed)) {
        if (!std::ranges::any_of(extensions, [&](const auto& extension) {
                return std::strcmp(extension.extensionName, name) == 0;
            })) {
            add(name);
        }
    }
    return missing;
}

}  // namespace vellus::gpu
