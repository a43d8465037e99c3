// What to do with a VkResult that the caller cannot go on after. Memory that has run out is thrown
// (base/out_of_memory.h); everything else goes down the fatal path, with the call and the result's name.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace fb::gpu {

// "VK_ERROR_DEVICE_LOST", or the number of a result that this code has no name for.
std::string result_name(VkResult result);

// Throws OutOfMemory if that is what the result says of the call.
void throw_if_out_of_memory(VkResult result, const char* call);
bool is_out_of_memory(VkResult result);

// Throws OutOfMemory, or goes down the fatal path, unless the result is a success code; returns the result.
VkResult check_result(VkResult result, const char* call, const char* file, int line);

// For tests: asked before each call that may run out of memory. Where it says true the call is not made and gives
// VK_ERROR_OUT_OF_DEVICE_MEMORY. Null: nobody asks.
using FailsCall = bool (*)(const char* call);
inline FailsCall fails_call = nullptr;

}  // namespace fb::gpu

// The result, for the caller to judge.
#define FB_VK_TRY(call) (::fb::gpu::fails_call && ::fb::gpu::fails_call(#call) ? VK_ERROR_OUT_OF_DEVICE_MEMORY : (call))
#define FB_VK(call) ::fb::gpu::check_result(FB_VK_TRY(call), #call, __FILE__, __LINE__)
