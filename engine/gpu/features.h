#pragma once

#include <string>
#include <vector>

#include "engine/gpu/vulkan.h"

namespace vellus::gpu {

/// The chain of features every device must have, as handed to vkCreateDevice.
struct RequiredFeatures {
    RequiredFeatures();
    RequiredFeatures(const RequiredFeatures&) = delete;
    RequiredFeatures& operator=(const RequiredFeatures&) = delete;

    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan11Features eleven;
    VkPhysicalDeviceVulkan12Features twelve;
    VkPhysicalDeviceVulkan13Features thirteen;
};

std::vector<const char*> required_extensions(bool windowed);

/// Names of what `physical` lacks, separated by commas; empty if it will do.
std::string missing_features(VkPhysicalDevice physical, bool windowed);

}  // namespace vellus::gpu
