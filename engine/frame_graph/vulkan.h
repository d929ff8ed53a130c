#pragma once

// Types and constants only: nothing of Vulkan is called outside execute.cpp and what it is made of.
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>
