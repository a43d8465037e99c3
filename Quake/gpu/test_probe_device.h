// A shader of Shaders/tests that answers queries one by one, as a function of them: what holds the device's results of
// a shared header to the host's.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/pipeline.h"

namespace fb::gpu {

// Outlives none of its device.
template <typename Query, typename Answer>
class ProbeDevice {
 public:
  ProbeDevice(Device& device, std::span<const std::uint32_t> spirv, std::string name)
      : device_(device), table_(device), pipeline_(device, table_, spirv, std::move(name)) {}

  std::vector<Answer> operator()(const std::vector<Query>& queries) {
    Buffer in(device_, BufferUse::kStorage, queries.size() * sizeof(Query), "queries");
    Buffer out(device_, BufferUse::kStorage, queries.size() * sizeof(Answer), "answers");
    upload_now(device_, in, std::span<const Query>(queries));
    table_.set_array(shared::kSetScene, 0, in);
    table_.set_array(shared::kSetFrame, 0, out);
    const auto count = static_cast<std::uint32_t>(queries.size());
    device_.run([&](Commands& commands) {
      commands.bind(table_);
      commands.push(std::array{count});
      commands.dispatch(pipeline_, (count + 63) / 64);
    });
    return read_now<Answer>(device_, out, queries.size());
  }

 private:
  Device& device_;
  BindingTable table_;
  ComputePipeline pipeline_;
};

}  // namespace fb::gpu
