#include "host/device_list.h"

#include <fmt/format.h>

#include "gpu/device.h"

namespace fb::host {

int print_devices(const std::string& preferred) {
  gpu::DeviceOptions options;
  options.preferred = preferred;
  const auto devices = gpu::list_devices(options);
  if (!devices) {
    fmt::print(stderr, "fullbright: {}\n", devices.error().message);
    return 1;
  }
  bool usable = false;
  int index = 0;
  for (const gpu::DeviceReport& device : *devices) {
    usable |= device.usable;
    fmt::print("{} {}: {} ({}, {}){}\n", device.would_be_chosen ? "*" : " ", index++, device.name, device.type,
               device.driver, device.usable ? "" : ": cannot be used");
    for (const std::string& lack : device.lacks) fmt::print("     {}\n", lack);
  }
  fmt::print("{}\n", usable ? "* would be chosen; -device NAME or INDEX chooses another" : "no device can be used");
  return usable ? 0 : 1;
}

}  // namespace fb::host
