// The descriptor sets that every pipeline shares: storage arrays by set and binding, as Shaders/shared/bindings.h
// numbers them, two uniform blocks, texel buffers, the top-level acceleration structure, and the arrays' device
// addresses.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <memory>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "shared/bindings.h"

namespace fb::gpu {

constexpr std::uint32_t kPushConstantBytes = 128;

// What the sets hold. Unset buffers are bound to a small dummy. Setting the same again costs nothing.
class BindingTable {
 public:
  explicit BindingTable(Device& device);
  ~BindingTable();
  BindingTable(const BindingTable&) = delete;
  BindingTable& operator=(const BindingTable&) = delete;
  // Storage array `binding` of `set`. Throws OutOfMemory if the device binds no buffer so large. Those of kSetTechnique
  // are texel buffers as well (kTexelsTechnique); their use is kStorage.
  void set_array(std::uint32_t set, std::uint32_t binding, const Buffer& buffer);
  // kBindFrameConstants for kSetScene, kBindTechniqueConstants for kSetTechnique.
  void set_uniform(std::uint32_t set, const Buffer& buffer);
  // Binding kBindTexelBuffers + index; the buffer's use is kStorage.
  void set_texels(std::uint32_t index, const Buffer& buffer);
  void set_tlas(VkAccelerationStructureKHR tlas);
  // Writes what changed; only between submissions. Commands::bind does so too.
  void flush() const;
  VkPipelineLayout layout() const;
  const std::array<VkDescriptorSet, shared::kSetCount>& sets() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::gpu
