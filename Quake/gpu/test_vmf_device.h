// shared/vmf.h evaluated by a device, for its tests and the table of Misc/docs/numerics.md.
#pragma once

#include "gpu/test_probe_device.h"
#include "shared/test_vmf_probe.h"
#include "test_vmf.spv.h"

namespace fb::gpu {

// Outlives none of its device.
class VmfDevice : public ProbeDevice<shared::VmfQuery, shared::VmfAnswer> {
 public:
  explicit VmfDevice(Device& device) : ProbeDevice(device, test_vmf_spv, "vmf") {}
};

}  // namespace fb::gpu
