// Compute pipelines: all share the descriptor sets of a BindingTable.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>

#include "gpu/binding_table.h"
#include "gpu/device.h"

namespace fb::gpu {

struct SpecializationConstant {
  std::uint32_t id;
  std::uint32_t value;  // bits: bool, int, uint or float
};

class ComputePipeline {
 public:
  ComputePipeline() = default;
  ComputePipeline(Device& device, const BindingTable& table, std::span<const std::uint32_t> spirv, std::string name,
                  std::span<const SpecializationConstant> constants = {});
  ~ComputePipeline();
  ComputePipeline(ComputePipeline&& other) noexcept;
  ComputePipeline& operator=(ComputePipeline&& other) noexcept;
  explicit operator bool() const { return pipeline_ != VK_NULL_HANDLE; }
  VkPipeline handle() const { return pipeline_; }
  const std::string& name() const { return name_; }

 private:
  Device* device_ = nullptr;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  std::string name_;
};

}  // namespace fb::gpu
