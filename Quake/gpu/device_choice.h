// Which physical devices there are, what each lacks, and which one is taken.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/device.h"

namespace fb::gpu {

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceReport report;
  std::uint32_t queue_family = 0;  // computes; draws too where the device can (only such queues present everywhere)
  std::uint32_t timestamp_bits = 0;
};

// Every device of the instance, in the driver's order; none is marked as chosen.
std::vector<PhysicalDevice> examine_devices(VkInstance instance, const DeviceOptions& options);

// Index of the best usable device: discrete, integrated, virtual, cpu; the first of equals. `preferred` narrows the
// choice to one index or to names that contain it, whatever the case. Fails naming what there is.
Result<std::size_t> choose_device(std::span<const DeviceReport> reports, std::string_view preferred);

}  // namespace fb::gpu
