// Compute pipelines: all share the descriptor sets of a BindingTable.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "gpu/binding_table.h"
#include "gpu/device.h"

namespace fb::gpu {

struct SpecializationConstant {
  std::uint32_t id;
  std::uint32_t value;  // bits: bool, int, uint or float
};

struct MadePipeline;

// Where the device has one of the same code and constants that was made not long ago, it is that one
// (DeviceOptions::shares_pipelines).
class ComputePipeline {
 public:
  ComputePipeline() = default;
  ComputePipeline(Device& device, const BindingTable& table, std::span<const std::uint32_t> spirv, std::string name,
                  std::span<const SpecializationConstant> constants = {});
  ComputePipeline(ComputePipeline&&) noexcept = default;
  ComputePipeline& operator=(ComputePipeline&&) noexcept = default;
  explicit operator bool() const { return made_ != nullptr; }
  VkPipeline handle() const;
  const std::string& name() const { return name_; }

 private:
  std::shared_ptr<const MadePipeline> made_;
  std::string name_;
};

}  // namespace fb::gpu
