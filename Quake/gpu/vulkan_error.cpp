#include "gpu/vulkan_error.h"

#include <fmt/format.h>

#include <string_view>

#include "base/check.h"
#include "base/out_of_memory.h"

namespace fb::gpu {

std::string result_name(VkResult result) {
  switch (result) {
#define FB_RESULT_NAME(name) \
  case name:                 \
    return #name
    FB_RESULT_NAME(VK_SUCCESS);
    FB_RESULT_NAME(VK_NOT_READY);
    FB_RESULT_NAME(VK_TIMEOUT);
    FB_RESULT_NAME(VK_INCOMPLETE);
    FB_RESULT_NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
    FB_RESULT_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    FB_RESULT_NAME(VK_ERROR_INITIALIZATION_FAILED);
    FB_RESULT_NAME(VK_ERROR_DEVICE_LOST);
    FB_RESULT_NAME(VK_ERROR_MEMORY_MAP_FAILED);
    FB_RESULT_NAME(VK_ERROR_LAYER_NOT_PRESENT);
    FB_RESULT_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
    FB_RESULT_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
    FB_RESULT_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
    FB_RESULT_NAME(VK_ERROR_TOO_MANY_OBJECTS);
    FB_RESULT_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
    FB_RESULT_NAME(VK_ERROR_FRAGMENTED_POOL);
    FB_RESULT_NAME(VK_ERROR_OUT_OF_POOL_MEMORY);
    FB_RESULT_NAME(VK_ERROR_FRAGMENTATION);
    FB_RESULT_NAME(VK_ERROR_SURFACE_LOST_KHR);
    FB_RESULT_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
    FB_RESULT_NAME(VK_SUBOPTIMAL_KHR);
    FB_RESULT_NAME(VK_ERROR_OUT_OF_DATE_KHR);
#undef FB_RESULT_NAME
    default:
      return fmt::format("VkResult {}", static_cast<int>(result));
  }
}

bool is_out_of_memory(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_MEMORY_MAP_FAILED:
    case VK_ERROR_TOO_MANY_OBJECTS:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTATION:
      return true;
    default:
      return false;
  }
}

namespace {

std::string_view name_of(std::string_view call) { return call.substr(0, call.find('(')); }

}  // namespace

void throw_if_out_of_memory(VkResult result, const char* call) {
  if (!is_out_of_memory(result)) return;
  throw OutOfMemory(fmt::format("the Vulkan driver is out of memory: {} gave {}", name_of(call), result_name(result)));
}

VkResult check_result(VkResult result, const char* call, const char* file, int line) {
  throw_if_out_of_memory(result, call);
  if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(fmt::format("the Vulkan device was lost: {}", name_of(call)));
  if (result < 0) fatal(file, line, fmt::format("Vulkan: {} gave {}", call, result_name(result)));
  return result;
}

}  // namespace fb::gpu
