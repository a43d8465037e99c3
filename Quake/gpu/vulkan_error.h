// What to do with a VkResult that the caller cannot go on after. Memory that has run out is thrown
// (base/out_of_memory.h), and so is the loss of a device; everything else goes down the fatal path, with the call and
// the result's name.
#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>

namespace fb::gpu {

// The driver has given the device up: a fault, a driver that was updated, a computer that slept. Nothing can be done
// with it or with what belongs to it but to destroy them and to make others.
class DeviceLost : public std::runtime_error {
  using runtime_error::runtime_error;
};

// "VK_ERROR_DEVICE_LOST", or the number of a result that this code has no name for.
std::string result_name(VkResult result);

// Throws OutOfMemory if that is what the result says of the call.
void throw_if_out_of_memory(VkResult result, const char* call);
bool is_out_of_memory(VkResult result);

// Throws OutOfMemory or DeviceLost, or goes down the fatal path, unless the result is a success code; returns the
// result.
VkResult check_result(VkResult result, const char* call, const char* file, int line);

// For tests: asked before each call that may fail. Where it says true the call is not made and gives `failing_result`.
// Null: nobody asks.
using FailsCall = bool (*)(const char* call);
inline FailsCall fails_call = nullptr;
inline VkResult failing_result = VK_ERROR_OUT_OF_DEVICE_MEMORY;

}  // namespace fb::gpu

// The result, for the caller to judge.
#define FB_VK_TRY(call) (::fb::gpu::fails_call && ::fb::gpu::fails_call(#call) ? ::fb::gpu::failing_result : (call))
#define FB_VK(call) ::fb::gpu::check_result(FB_VK_TRY(call), #call, __FILE__, __LINE__)
