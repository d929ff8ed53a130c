#define VOLK_IMPLEMENTATION
#include "engine/gpu/vulkan.h"

namespace vellus::gpu {

VkFormat to_vulkan(Format format) {
    switch (format) {
        case Format::kUndefined:
            return VK_FORMAT_UNDEFINED;
        case Format::kR8Unorm:
            return VK_FORMAT_R8_UNORM;
        case Format::kRgba8Unorm:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case Format::kRgba8Srgb:
            return VK_FORMAT_R8G8B8A8_SRGB;
        case Format::kBgra8Unorm:
            return VK_FORMAT_B8G8R8A8_UNORM;
        case Format::kBgra8Srgb:
            return VK_FORMAT_B8G8R8A8_SRGB;
        case Format::kR16Float:
            return VK_FORMAT_R16_SFLOAT;
        case Format::kRg16Float:
            return VK_FORMAT_R16G16_SFLOAT;
        case Format::kRgba16Float:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case Format::kR32Uint:
            return VK_FORMAT_R32_UINT;
        case Format::kR32Float:
            return VK_FORMAT_R32_SFLOAT;
        case Format::kRg32Float:
            return VK_FORMAT_R32G32_SFLOAT;
        case Format::kRgba32Float:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case Format::kB10Gr11Ufloat:
            return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
        case Format::kD32Float:
            return VK_FORMAT_D32_SFLOAT;
    }
    return VK_FORMAT_UNDEFINED;
}

Error vulkan_error(VkResult result, std::string where) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return {"out of host memory", std::move(where),
                    "close other programs or shrink the scene"};
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return {"out of device memory", std::move(where),
                    "use fewer strands, a smaller picture or another --device"};
        case VK_ERROR_DEVICE_LOST:
            return {"the device was lost", std::move(where),
                    "update the driver, or start again with --validation to see why"};
        case VK_ERROR_SURFACE_LOST_KHR:
            return {"the window's surface was lost", std::move(where), ""};
        default:
            return {fmt::format("Vulkan call failed with VkResult {}", static_cast<int>(result)),
                    std::move(where), "run with --validation to see why"};
    }
}

}  // namespace vellus::gpu
