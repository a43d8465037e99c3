// Compute pipelines and the two descriptor sets that all of them share.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"

namespace fb::gpu {

// Set 0: bindings 0..kSceneBuffers-1 are storage buffers, kUniformBinding a uniform buffer, kTlasBinding the top-level
// acceleration structure (only where the device has ray query). Set 1: bindings 0..kFrameBuffers-1 are storage buffers.
// Bindings kTexelBinding.. are uniform texel buffers of four words a texel (usamplerBuffer): a second way to read
// buffers, which some drivers do faster. Together they stay within 32 storage buffers a stage, which every desktop
// driver and lavapipe offer.
constexpr std::uint32_t kSceneBuffers = 14;
constexpr std::uint32_t kFrameBuffers = 17;
constexpr std::uint32_t kUniformBinding = 16;
constexpr std::uint32_t kTlasBinding = 17;
constexpr std::uint32_t kTexelBinding = 18;
constexpr std::uint32_t kTexelBuffers = 4;
constexpr std::uint32_t kPushConstantBytes = 128;

// What the two sets hold. Unset buffers are bound to a small dummy. Setting the same again costs nothing.
class BindingTable {
 public:
  explicit BindingTable(Device& device);
  ~BindingTable();
  BindingTable(const BindingTable&) = delete;
  BindingTable& operator=(const BindingTable&) = delete;
  void set_scene(std::uint32_t binding, const Buffer& buffer);
  void set_frame(std::uint32_t binding, const Buffer& buffer);
  void set_uniform(const Buffer& buffer);
  // Binding kTexelBinding + index; the buffer's use is kStorage. At most DeviceLimits::max_texel_buffer_bytes of it are
  // seen.
  void set_texels(std::uint32_t index, const Buffer& buffer);
  void set_tlas(VkAccelerationStructureKHR tlas);
  // Writes what changed; only between submissions. Commands::bind does so too.
  void flush() const;
  VkPipelineLayout layout() const;
  std::array<VkDescriptorSet, 2> sets() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

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
