// What a Device holds, for the files of this module alone.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/instance.h"

namespace fb::gpu {

// Entry points of VK_KHR_acceleration_structure; all null unless ray queries are on.
struct AccelerationStructureCalls {
  PFN_vkCreateAccelerationStructureKHR create = nullptr;
  PFN_vkDestroyAccelerationStructureKHR destroy = nullptr;
  PFN_vkGetAccelerationStructureBuildSizesKHR build_sizes = nullptr;
  PFN_vkGetAccelerationStructureDeviceAddressKHR address = nullptr;
  PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
};

// Of a software driver, bytes: what lavapipe takes of the address space at its start (its threads' stacks and heaps, on
// a processor of two cores a third of this), and what a shader's compilation and a frame may take.
constexpr std::size_t kRoomToStart = 512u << 20u, kRoomToWork = 64u << 20u;

// Names and labels for debuggers and validation messages; null without VK_EXT_debug_utils.
struct DebugCalls {
  PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
};

// A pipeline, and what it was made of; it may outlive the binding table.
struct MadePipeline {
  MadePipeline(VkDevice of, std::uint64_t from) : device(of), key(from) {}
  ~MadePipeline() { vkDestroyPipeline(device, pipeline, nullptr); }
  MadePipeline(const MadePipeline&) = delete;
  MadePipeline& operator=(const MadePipeline&) = delete;

  VkDevice device = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  std::uint64_t key = 0;
};

// The pipelines that a device used last. All of its binding tables have the same layout, so one serves all of them: a
// renderer finds what another has made. Several threads may ask.
class SharedPipelines {
 public:
  std::shared_ptr<const MadePipeline> find(std::uint64_t key);
  void keep(std::shared_ptr<const MadePipeline> made);
  void clear() { list_.clear(); }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<const MadePipeline>> list_;  // the one that was used last is the last
};

struct Device::Impl {
  ~Impl();
  // Throws OutOfMemory where the host has little left and the driver is software: lavapipe and its compiler end or
  // break the program where they find no memory themselves.
  void leave_driver_room(std::size_t bytes = kRoomToWork) const;
  void set_name(VkObjectType type, std::uint64_t object, std::string_view name) const;

  std::unique_ptr<Instance> instance;
  DeviceOptions options;
  DeviceReport report;
  DeviceLimits limits;
  bool ray_query = false;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory{};
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  std::uint32_t timestamp_bits = 0;
  AccelerationStructureCalls acceleration;
  DebugCalls debug;

  // One command buffer a depth of nested runs.
  struct Recording {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
  };
  VkCommandPool pool = VK_NULL_HANDLE;
  Recording& recording_at(std::size_t depth);  // made if it is not there
  class Run;                                   // in device.cpp
  std::vector<Recording> recordings;
  std::size_t depth = 0;
  bool started = false;  // the first recording is submitted and was not waited for

  void submit(Device& device, Run& run, const std::function<void(Commands&)>& record);
  void wait_for(Recording& recording);  // and makes it ready again
  void drop(Recording& recording);      // nobody knows what became of it

  std::uint64_t allocated_bytes = 0;
  std::uint64_t next_serial = 1;
  Buffer upload_staging, readback_staging;
  SharedPipelines pipelines;
  Buffer no_triangle;  // zeros: a degenerate triangle's vertices and indices
};

}  // namespace fb::gpu
