#include "gpu/acceleration_structure.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

VkAccelerationStructureBuildGeometryInfoKHR build_info(VkAccelerationStructureTypeKHR type, BuildPreference preference,
                                                       const VkAccelerationStructureGeometryKHR& geometry) {
  auto info = vk_struct<VkAccelerationStructureBuildGeometryInfoKHR>(
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR);
  info.type = type;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.flags = preference == BuildPreference::kFastTrace ? VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR
                                                         : VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR;
  info.geometryCount = 1;
  info.pGeometries = &geometry;
  return info;
}

VkAccelerationStructureBuildSizesInfoKHR build_sizes(const Device::Impl& device,
                                                     const VkAccelerationStructureBuildGeometryInfoKHR& info,
                                                     std::uint32_t primitives) {
  auto sizes = vk_struct<VkAccelerationStructureBuildSizesInfoKHR>(
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR);
  device.acceleration.build_sizes(device.device, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &primitives,
                                  &sizes);
  return sizes;
}

void destroy(Device* device, VkAccelerationStructureKHR& handle) {
  device->settle();
  if (handle) device->impl().acceleration.destroy(device->handle(), handle, nullptr);
  handle = VK_NULL_HANDLE;
}

// A structure over the whole of `storage`, both made larger if need be; true if that changed the handle. Where there is
// no memory for it the former one stays.
bool ensure_structure(Device& device, VkAccelerationStructureTypeKHR type, VkDeviceSize bytes, const char* name,
                      Buffer& storage, VkAccelerationStructureKHR& handle) {
  if (handle && bytes <= storage.size()) return false;
  Buffer larger(device, BufferUse::kAccelerationStructure, std::max(bytes, storage.size() + storage.size() / 2), name);
  auto info = vk_struct<VkAccelerationStructureCreateInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR);
  info.buffer = larger.handle();
  info.size = larger.size();
  info.type = type;
  const auto vkCreateAccelerationStructureKHR = device.impl().acceleration.create;
  VkAccelerationStructureKHR made = VK_NULL_HANDLE;
  FB_VK(vkCreateAccelerationStructureKHR(device.handle(), &info, nullptr, &made));
  destroy(&device, handle);
  handle = made;
  storage = std::move(larger);
  device.impl().set_name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, reinterpret_cast<std::uint64_t>(handle), name);
  return true;
}

// The aligned address of at least `bytes` of scratch memory.
VkDeviceAddress ensure_scratch(Device& device, VkDeviceSize bytes, Buffer& scratch) {
  const VkDeviceSize alignment = device.limits().min_acceleration_structure_scratch_alignment;
  const VkDeviceSize needed = bytes + alignment - 1;
  if (!scratch)
    scratch = Buffer(device, BufferUse::kScratch, needed, "acceleration structure scratch");
  else
    scratch.reserve(needed);
  return (scratch.address() + alignment - 1) / alignment * alignment;
}

VkAccelerationStructureGeometryKHR instance_geometry(VkDeviceAddress instances) {
  auto geometry = vk_struct<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  geometry.geometry.instances.data.deviceAddress = instances;
  return geometry;
}

VkAccelerationStructureGeometryKHR triangle_geometry(Device& device, const TriangleGeometry& from) {
  auto geometry = vk_struct<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
  geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
  geometry.flags = from.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : 0;
  auto& triangles = geometry.geometry.triangles;
  triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
  triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
  triangles.vertexStride = 3 * sizeof(float);
  triangles.indexType = VK_INDEX_TYPE_UINT32;
  if (from.triangle_count == 0) {
    // One degenerate triangle: less trodden paths than an empty list's are where drivers differ.
    Buffer& zeros = device.impl().no_triangle;
    if (!zeros) {
      Buffer made(device, BufferUse::kGeometry, 64, "no triangle");
      const std::uint32_t words[16] = {};
      upload_now(device, made, words, sizeof(words));
      zeros = std::move(made);
    }
    triangles.vertexData.deviceAddress = zeros.address();
    triangles.maxVertex = 0;
    triangles.indexData.deviceAddress = zeros.address();
    return geometry;
  }
  FB_CHECK(from.vertices != nullptr && from.indices != nullptr && from.vertex_count > 0);
  FB_CHECK_LE(from.vertex_offset + VkDeviceSize{from.vertex_count} * triangles.vertexStride, from.vertices->size());
  FB_CHECK_LE(from.index_offset + VkDeviceSize{from.triangle_count} * 12, from.indices->size());
  triangles.vertexData.deviceAddress = from.vertices->address() + from.vertex_offset;
  triangles.maxVertex = from.vertex_count - 1;
  triangles.indexData.deviceAddress = from.indices->address() + from.index_offset;
  return geometry;
}

VkAccelerationStructureInstanceKHR device_instance(const TopLevelInstance& from) {
  VkAccelerationStructureInstanceKHR to{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) to.transform.matrix[row][column] = from.transform[column][row];
  to.instanceCustomIndex = from.custom_index & 0xffffffu;
  to.mask = from.mask;
  to.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
  to.accelerationStructureReference = from.bottom_level;
  return to;
}

void record_build(const Device::Impl& device, Commands& commands,
                  const VkAccelerationStructureBuildGeometryInfoKHR& info, std::uint32_t primitives) {
  VkAccelerationStructureBuildRangeInfoKHR range{};
  range.primitiveCount = primitives;
  const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
  device.acceleration.build(commands.handle(), 1, &info, &ranges);
}

}  // namespace

BottomLevel::~BottomLevel() { release(); }

void BottomLevel::release() {
  if (device_) destroy(device_, handle_);
  device_ = nullptr;
  address_ = 0;
}

BottomLevel::BottomLevel(BottomLevel&& other) noexcept { *this = std::move(other); }

BottomLevel& BottomLevel::operator=(BottomLevel&& other) noexcept {
  if (this == &other) return *this;
  release();
  device_ = std::exchange(other.device_, nullptr);
  handle_ = std::exchange(other.handle_, VK_NULL_HANDLE);
  storage_ = std::move(other.storage_);
  scratch_ = std::move(other.scratch_);
  address_ = std::exchange(other.address_, 0);
  return *this;
}

void BottomLevel::build(Device& device, Commands& commands, const TriangleGeometry& geometry,
                        BuildPreference preference) {
  FB_CHECK(device.has_ray_query());
  device_ = &device;
  const Device::Impl& d = device.impl();
  constexpr auto kType = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  const VkAccelerationStructureGeometryKHR triangles = triangle_geometry(device, geometry);
  const std::uint32_t count = std::max(1u, geometry.triangle_count);
  auto info = build_info(kType, preference, triangles);
  const auto sizes = build_sizes(d, info, count);
  if (ensure_structure(device, kType, sizes.accelerationStructureSize, "bottom level", storage_, handle_)) {
    auto ask = vk_struct<VkAccelerationStructureDeviceAddressInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR);
    ask.accelerationStructure = handle_;
    address_ = d.acceleration.address(d.device, &ask);
  }
  info.dstAccelerationStructure = handle_;
  info.scratchData.deviceAddress = ensure_scratch(device, sizes.buildScratchSize, scratch_);
  record_build(d, commands, info, count);
}

TopLevel::~TopLevel() { release(); }

void TopLevel::release() {
  if (device_) destroy(device_, handle_);
  device_ = nullptr;
  capacity_ = 0;
}

TopLevel::TopLevel(TopLevel&& other) noexcept { *this = std::move(other); }

TopLevel& TopLevel::operator=(TopLevel&& other) noexcept {
  if (this == &other) return *this;
  release();
  device_ = std::exchange(other.device_, nullptr);
  handle_ = std::exchange(other.handle_, VK_NULL_HANDLE);
  storage_ = std::move(other.storage_);
  scratch_ = std::move(other.scratch_);
  instances_ = std::move(other.instances_);
  capacity_ = std::exchange(other.capacity_, 0);
  return *this;
}

bool TopLevel::reserve(Device& device, std::uint32_t instances, BuildPreference preference) {
  FB_CHECK(device.has_ray_query());
  device_ = &device;
  if (handle_ && instances <= capacity_) return false;
  const std::uint32_t capacity = std::max(capacity_, instances);
  const VkDeviceSize table = std::max(1u, capacity) * sizeof(VkAccelerationStructureInstanceKHR);
  if (!instances_)
    instances_ = Buffer(device, BufferUse::kUpload, table, "top level instances");
  else
    instances_.reserve(table);
  constexpr auto kType = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  const auto geometry = instance_geometry(instances_.address());
  const auto sizes = build_sizes(device.impl(), build_info(kType, preference, geometry), capacity);
  ensure_scratch(device, sizes.buildScratchSize, scratch_);
  const bool changed = ensure_structure(device, kType, sizes.accelerationStructureSize, "top level", storage_, handle_);
  capacity_ = capacity;
  return changed;
}

void TopLevel::build(Device& device, Commands& commands, std::span<const TopLevelInstance> instances,
                     BuildPreference preference) {
  const auto count = static_cast<std::uint32_t>(instances.size());
  reserve(device, count, preference);
  auto* table = static_cast<VkAccelerationStructureInstanceKHR*>(instances_.mapped());
  std::transform(instances.begin(), instances.end(), table, device_instance);

  const Device::Impl& d = device.impl();
  constexpr auto kType = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  const auto geometry = instance_geometry(instances_.address());
  auto info = build_info(kType, preference, geometry);
  const auto sizes = build_sizes(d, info, count);
  ensure_structure(device, kType, sizes.accelerationStructureSize, "top level", storage_, handle_);
  info.dstAccelerationStructure = handle_;
  info.scratchData.deviceAddress = ensure_scratch(device, sizes.buildScratchSize, scratch_);
  record_build(d, commands, info, count);
}

}  // namespace fb::gpu
