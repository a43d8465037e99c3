// The Vulkan instance, and the validation layers with the log of what they say.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "base/result.h"
#include "gpu/device.h"

namespace fb::gpu {

// Warnings and errors of the layers: all are counted, each distinct text is logged once.
class ValidationLog {
 public:
  void add(bool is_error, const std::string& text);
  std::uint64_t count() const { return count_; }

 private:
  std::atomic<std::uint64_t> count_{0};
  std::mutex mutex_;
  std::set<std::string> seen_;
};

class Instance {
 public:
  // Fails where there is no loader of Vulkan 1.2, no driver at all, or an extension asked for is missing.
  static Result<std::unique_ptr<Instance>> create(const DeviceOptions& options);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return handle_; }
  bool has_debug_utils() const { return has_debug_utils_; }
  const ValidationLog& validation() const { return validation_; }

 private:
  Instance() = default;
  VkInstance handle_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  bool has_debug_utils_ = false;
  ValidationLog validation_;
};

}  // namespace fb::gpu
