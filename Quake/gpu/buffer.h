// Buffers: device-local storage, mapped upload memory, mapped readback memory.
#pragma once

#include <vulkan/vulkan.h>

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace fb::gpu {

enum class BufferUse {
  kStorage,   // device-local; shaders read and write, dispatches take their groups from it; source and target of copies
  kUpload,    // mapped, written by the host, read by shaders and copies: small tables that change each frame
  kReadback,  // mapped and cached; target of copies
  kUniform,   // as kUpload, bound as a uniform buffer
  kGeometry,  // kStorage that acceleration structures are built from as well
  kAccelerationStructure,
  kScratch,
};

// Bytes of the largest buffer for this use: what the device allocates and, where shaders see it, binds.
VkDeviceSize largest_buffer(const Device& device, BufferUse use);

class Buffer {
 public:
  Buffer() = default;
  // Rounds the size up to 16 bytes, at least 16; the contents are undefined. Throws OutOfMemory, with the size and
  // name, where the device has no memory for it, or allows nothing so large.
  Buffer(Device& device, BufferUse use, VkDeviceSize bytes, std::string name);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
  VkBuffer handle() const { return buffer_; }
  VkDeviceSize size() const { return size_; }
  VkDeviceAddress address() const;
  void* mapped() { return mapped_; }
  const void* mapped() const { return mapped_; }
  template <typename T>
  std::span<T> mapped_as() {
    return {static_cast<T*>(mapped_), static_cast<std::size_t>(size_ / sizeof(T))};
  }

  // Grows to at least `bytes` (by half again), losing the contents; true if the handle changed. Where there is no
  // memory for the larger one, this one stays.
  bool reserve(VkDeviceSize bytes);
  // Differs between any two buffers ever made: handles are used again, this is not. 0: no buffer.
  std::uint64_t serial() const { return serial_; }
  const std::string& name() const { return name_; }

 private:
  void release();

  Device* device_ = nullptr;
  BufferUse use_ = BufferUse::kStorage;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkDeviceSize size_ = 0;
  VkDeviceSize allocated_ = 0;
  std::uint64_t serial_ = 0;
  void* mapped_ = nullptr;
  std::string name_;
};

// Uploads through a staging buffer and waits: for what changes rarely.
void upload_now(Device& device, Buffer& target, const void* data, VkDeviceSize bytes, VkDeviceSize offset = 0);
template <typename T>
void upload_now(Device& device, Buffer& target, std::span<const T> items, VkDeviceSize offset = 0) {
  upload_now(device, target, items.data(), items.size_bytes(), offset);
}
// Copies to the host and waits.
void read_now(Device& device, const Buffer& source, void* data, VkDeviceSize bytes, VkDeviceSize offset = 0);
template <typename T>
std::vector<T> read_now(Device& device, const Buffer& source, std::size_t count, VkDeviceSize offset = 0) {
  std::vector<T> items(count);
  read_now(device, source, items.data(), count * sizeof(T), offset);
  return items;
}

}  // namespace fb::gpu
