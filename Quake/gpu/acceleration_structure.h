// VK_KHR_acceleration_structure: bottom levels over triangles, and the top level over instances, built on the device.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"

namespace fb::gpu {

enum class BuildPreference { kFastTrace, kFastBuild };

// One geometry of triangles: positions vec3 (12 bytes apart), 32-bit indices. Which side counts and whether a triangle
// is opaque are the shader's business: all are built as non-opaque only if `opaque` is false, and no instance culls.
struct TriangleGeometry {
  const Buffer* vertices = nullptr;
  VkDeviceSize vertex_offset = 0;  // bytes
  std::uint32_t vertex_count = 0;
  const Buffer* indices = nullptr;
  VkDeviceSize index_offset = 0;  // bytes
  std::uint32_t triangle_count = 0;
  bool opaque = true;
};

class BottomLevel {
 public:
  BottomLevel() = default;
  ~BottomLevel();
  BottomLevel(BottomLevel&& other) noexcept;
  BottomLevel& operator=(BottomLevel&& other) noexcept;
  // (Re)builds; memory is reused when it suffices, else the address changes. The scratch memory is the structure's own.
  // No triangles: a structure that no ray hits.
  void build(Device& device, Commands& commands, const TriangleGeometry& geometry, BuildPreference preference);
  VkDeviceAddress address() const { return address_; }
  explicit operator bool() const { return address_ != 0; }

 private:
  void release();

  Device* device_ = nullptr;
  VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
  Buffer storage_, scratch_;
  VkDeviceAddress address_ = 0;
};

struct TopLevelInstance {
  mat4x3 transform{1.0f};
  std::uint32_t custom_index = 0;  // 24 bits
  std::uint8_t mask = 0xff;
  VkDeviceAddress bottom_level = 0;
};

class TopLevel {
 public:
  TopLevel() = default;
  ~TopLevel();
  TopLevel(TopLevel&& other) noexcept;
  TopLevel& operator=(TopLevel&& other) noexcept;
  // Makes room for so many instances, so that builds of fewer keep the handle; true if the handle changed (what was
  // built is gone then). Between submissions.
  bool reserve(Device& device, std::uint32_t instances, BuildPreference preference);
  // (Re)builds; the handle stays unless there are more instances than ever before. An instance without a bottom level
  // is not seen. Instances are best sorted along a curve (lavapipe halves the list in the order given).
  void build(Device& device, Commands& commands, std::span<const TopLevelInstance> instances,
             BuildPreference preference);
  VkAccelerationStructureKHR handle() const { return handle_; }

 private:
  void release();

  Device* device_ = nullptr;
  VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
  Buffer storage_, scratch_, instances_;
  std::uint32_t capacity_ = 0;
};

}  // namespace fb::gpu
