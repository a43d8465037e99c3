// What to do with a VkResult that the program cannot go on after: the fatal path, with the call and the result's name.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace fb::gpu {

// "VK_ERROR_DEVICE_LOST", or the number of a result that this code has no name for.
std::string result_name(VkResult result);

// Goes down the fatal path unless the result is a success code; returns the result.
VkResult check_result(VkResult result, const char* call, const char* file, int line);

}  // namespace fb::gpu

#define FB_VK(call) ::fb::gpu::check_result((call), #call, __FILE__, __LINE__)
