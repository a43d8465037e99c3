// The Vulkan device: choosing one, what it lacks, its queue, and the one way to submit work. Knows no Quake.
//
// All shaders are compute shaders over storage buffers; there are no images but a swapchain's. The descriptor
// sets of gpu/binding_table.h serve every pipeline.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace fb::gpu {

struct DeviceOptions {
  std::string preferred;    // part of a device's name, or its index; empty: the best
  bool validation = false;  // VK_LAYER_KHRONOS_validation; its messages count in Device::validation_messages()
  bool synchronization_validation = false;       // with validation: missing barriers as well (slow)
  bool ray_query = true;                         // use it where there is one
  std::vector<const char*> instance_extensions;  // what the window system asks for; empty: headless
  bool present = false;                          // needs a queue that can present
  bool shares_pipelines = true;                  // those of one shader and its constants are made once (gpu/pipeline.h)
  VkDeviceSize most_buffer_bytes = 0;  // for tests: a storage buffer's, if the device allows more; 0: as it does
};

// A device as -listdevices shows it.
struct DeviceReport {
  std::string name, driver;
  std::string type;                // "discrete", "integrated", "virtual", "cpu"
  std::vector<std::string> lacks;  // what it lacks and what follows, one sentence each
  bool usable = false, has_ray_query = false, has_addresses = false, is_software = false, would_be_chosen = false;
};
Result<std::vector<DeviceReport>> list_devices(const DeviceOptions& options);

struct DeviceLimits {
  VkDeviceSize max_storage_buffer_range = 0;  // of a storage buffer that is a texel buffer as well
  VkDeviceSize max_allocation_bytes = 0;
  VkDeviceSize local_memory_bytes = 0;            // of the largest heap that is the device's own
  std::array<std::uint32_t, 3> max_workgroups{};  // of a dispatch
  float timestamp_period_ns = 0;                  // 0: no timestamps
  std::uint32_t max_workgroup_invocations = 0;
  VkDeviceSize min_acceleration_structure_scratch_alignment = 0;
};

class Buffer;
class Commands;

class Device {
 public:
  // What is out of memory later is thrown (base/out_of_memory.h), by all of this module.
  static Result<std::unique_ptr<Device>> create(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceReport& report() const;
  bool has_ray_query() const;
  bool has_addresses() const;  // shaders may read buffers by their device address
  bool is_software() const;    // lavapipe and its like
  const DeviceLimits& limits() const;
  const DeviceOptions& options() const;  // that it was made by
  // Warnings and errors of the validation layers so far, each logged once; tests hold this to zero.
  std::uint64_t validation_messages() const;
  // Device memory allocated now, bytes.
  std::uint64_t allocated_bytes() const;

  // Records with `record`, submits and waits. A run inside another's `record` finishes before the outer one starts.
  // Where something throws, what was recorded is dropped, and the next run is as good as any. One thread at a time.
  void run(const std::function<void(Commands&)>& record);
  // As run(), but does not wait: the host goes on beside the device. Until finish() the host writes to no memory that
  // was recorded, and changes no binding table. One at a time: run() and start() finish the former first, and whatever
  // is destroyed waits.
  void start(const std::function<void(Commands&)>& record);
  void finish();           // waits for what was started, if anything was
  void settle() noexcept;  // the same for destructors: whatever becomes of it

  VkInstance instance() const;
  VkPhysicalDevice physical() const;
  VkDevice handle() const;
  VkQueue queue() const;
  std::uint32_t queue_family() const;

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  explicit Device(std::unique_ptr<Impl> impl);
  static Result<std::unique_ptr<Device>> make(const DeviceOptions& options);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::gpu
