// shared/vmf.h evaluated by a device, for its tests and the table of Misc/docs/numerics.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/pipeline.h"
#include "shared/test_vmf_probe.h"
#include "test_vmf.spv.h"

namespace fb::gpu {

// Outlives none of its device.
class VmfDevice {
 public:
  explicit VmfDevice(Device& device)
      : device_(device), table_(device), pipeline_(device, table_, test_vmf_spv, "vmf") {}

  std::vector<shared::VmfAnswer> operator()(const std::vector<shared::VmfQuery>& queries) {
    Buffer in(device_, BufferUse::kStorage, queries.size() * sizeof(shared::VmfQuery), "queries");
    Buffer out(device_, BufferUse::kStorage, queries.size() * sizeof(shared::VmfAnswer), "answers");
    upload_now(device_, in, std::span<const shared::VmfQuery>(queries));
    table_.set_array(shared::kSetScene, 0, in);
    table_.set_array(shared::kSetFrame, 0, out);
    const auto count = static_cast<std::uint32_t>(queries.size());
    device_.run([&](Commands& commands) {
      commands.bind(table_);
      commands.push(std::array{count});
      commands.dispatch(pipeline_, (count + 63) / 64);
    });
    return read_now<shared::VmfAnswer>(device_, out, queries.size());
  }

 private:
  Device& device_;
  BindingTable table_;
  ComputePipeline pipeline_;
};

}  // namespace fb::gpu
