#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <volk.h>

#include "engine/gpu/format.h"
#include "engine/platform/result.h"

namespace vellus::gpu {

VkFormat to_vulkan(Format format);

/// The error of a failed Vulkan call: `where` names the resource or call; out of memory, lost
/// device and lost surface carry their own remedy.
Error vulkan_error(VkResult result, std::string where);

}  // namespace vellus::gpu
