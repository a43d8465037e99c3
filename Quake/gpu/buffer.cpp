#include "gpu/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "base/check.h"
#include "base/out_of_memory.h"
#include "gpu/commands.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

constexpr VkDeviceSize kStagingBytes = 8u << 20u;

VkBufferUsageFlags usage_flags(BufferUse use, const Device::Impl& device) {
  constexpr VkBufferUsageFlags kCopy = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  constexpr VkBufferUsageFlags kAddress = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  constexpr VkBufferUsageFlags kBuildInput = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
  const VkBufferUsageFlags array =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | (device.report.has_addresses ? kAddress : VkBufferUsageFlags{0});
  switch (use) {
    case BufferUse::kStorage:
      return kCopy | array | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    case BufferUse::kUpload:
    case BufferUse::kGeometry:
      return kCopy | array | (device.ray_query ? kBuildInput : VkBufferUsageFlags{0});
    case BufferUse::kReadback:
      return kCopy;
    case BufferUse::kUniform:
      return kCopy | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    case BufferUse::kAccelerationStructure:
      return VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    case BufferUse::kScratch:
      return array;
  }
  return 0;
}

// Kinds of memory to try, best first.
std::vector<VkMemoryPropertyFlags> memory_wishes(BufferUse use) {
  constexpr VkMemoryPropertyFlags kMapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (use) {
    case BufferUse::kUpload:
    case BufferUse::kUniform:
      return {kMapped | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kMapped};
    case BufferUse::kReadback:
      return {kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kMapped};
    default:
      return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
  }
}

bool is_mapped(BufferUse use) {
  return use == BufferUse::kUpload || use == BufferUse::kUniform || use == BufferUse::kReadback;
}

// Mesa's lavapipe before 24 compiles a shader anew where a texel buffer's size becomes or ceases to be a power of two,
// or has none of these bits: its key of compiled shaders holds what it would ask of an image. So no array has such a
// size.
VkDeviceSize size_of_one_kind(VkDeviceSize size) {
  constexpr VkDeviceSize kLevelBits = 0xff00, kStep = 0x100;
  while (std::has_single_bit(size) || (size & kLevelBits) == 0) size += kStep;
  return size;
}

VkDeviceMemory allocate(const Device::Impl& device, BufferUse use, const VkMemoryRequirements& needs) {
  auto flags = vk_struct<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  auto info = vk_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  if (usage_flags(use, device) & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) info.pNext = &flags;
  info.allocationSize = needs.size;
  for (const VkMemoryPropertyFlags wish : memory_wishes(use)) {
    for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
      if (!(needs.memoryTypeBits & (1u << type))) continue;
      if ((device.memory.memoryTypes[type].propertyFlags & wish) != wish) continue;
      if (needs.size > device.memory.memoryHeaps[device.memory.memoryTypes[type].heapIndex].size) continue;
      info.memoryTypeIndex = type;
      VkDeviceMemory memory = VK_NULL_HANDLE;
      if (FB_VK_TRY(vkAllocateMemory(device.device, &info, nullptr, &memory)) == VK_SUCCESS) return memory;
    }
  }
  return VK_NULL_HANDLE;
}

[[noreturn]] void out_of_memory(const Device::Impl& device, const std::string& name, VkDeviceSize bytes) {
  throw OutOfMemory(fmt::format("{0} is out of memory: no {1} for \"{2}\" beside the {3} that are in use",
                                device.report.name, memory_text(bytes), name, memory_text(device.allocated_bytes)));
}

// What the device says it cannot have is not tried: some drivers take it and break later.
void check_limits(const Device& device, BufferUse use, const std::string& name, VkDeviceSize bytes) {
  if (const VkDeviceSize most = largest_buffer(device, use); bytes > most)
    throw OutOfMemory(fmt::format("\"{}\" needs a buffer of {}; {} allows {}", name, memory_text(bytes),
                                  device.report().name, memory_text(most)));
}

}  // namespace

VkDeviceSize largest_buffer(const Device& device, BufferUse use) {
  const DeviceLimits& limits = device.limits();
  const bool bound = use == BufferUse::kStorage || use == BufferUse::kGeometry;
  return bound ? std::min(limits.max_storage_buffer_range, limits.max_allocation_bytes) : limits.max_allocation_bytes;
}

// Delegates, so that what was made before something throws is given back.
Buffer::Buffer(Device& device, BufferUse use, VkDeviceSize bytes, std::string name) : Buffer() {
  Device::Impl& d = device.impl();
  FB_CHECK_LE(bytes, ~VkDeviceSize{0} - 15);
  const VkDeviceSize size = std::max<VkDeviceSize>(16, (bytes + 15) & ~VkDeviceSize{15});
  check_limits(device, use, name, size);
  device_ = &device;
  use_ = use;
  name_ = std::move(name);
  size_ = size;

  auto info = vk_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  const bool as_texels = (usage_flags(use, d) & VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT) != 0;
  info.size =
      as_texels && d.report.is_software ? std::min(size_of_one_kind(size_), largest_buffer(device, use)) : size_;
  info.usage = usage_flags(use, d);
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  const VkResult made = FB_VK_TRY(vkCreateBuffer(d.device, &info, nullptr, &buffer_));
  if (is_out_of_memory(made)) out_of_memory(d, name_, size_);
  check_result(made, "vkCreateBuffer", __FILE__, __LINE__);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(d.device, buffer_, &needs);
  memory_ = allocate(d, use, needs);
  if (!memory_) out_of_memory(d, name_, size_);
  allocated_ = needs.size;
  d.allocated_bytes += allocated_;
  FB_VK(vkBindBufferMemory(d.device, buffer_, memory_, 0));
  if (is_mapped(use)) FB_VK(vkMapMemory(d.device, memory_, 0, VK_WHOLE_SIZE, 0, &mapped_));
  serial_ = d.next_serial++;
  d.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), name_);
}

Buffer::~Buffer() { release(); }

void Buffer::release() {
  if (!device_) return;
  device_->settle();
  Device::Impl& d = device_->impl();
  if (mapped_) vkUnmapMemory(d.device, memory_);
  vkDestroyBuffer(d.device, buffer_, nullptr);
  vkFreeMemory(d.device, memory_, nullptr);
  d.allocated_bytes -= allocated_;
  device_ = nullptr;
  buffer_ = VK_NULL_HANDLE;
  memory_ = VK_NULL_HANDLE;
  size_ = allocated_ = serial_ = 0;
  mapped_ = nullptr;
}

Buffer::Buffer(Buffer&& other) noexcept { *this = std::move(other); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  if (this == &other) return *this;
  release();
  device_ = std::exchange(other.device_, nullptr);
  use_ = other.use_;
  buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
  memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
  size_ = std::exchange(other.size_, 0);
  allocated_ = std::exchange(other.allocated_, 0);
  serial_ = std::exchange(other.serial_, 0);
  mapped_ = std::exchange(other.mapped_, nullptr);
  name_ = std::move(other.name_);
  return *this;
}

VkDeviceAddress Buffer::address() const {
  FB_CHECK(buffer_ != VK_NULL_HANDLE);
  FB_CHECK(usage_flags(use_, device_->impl()) & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT);
  auto info = vk_struct<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
  info.buffer = buffer_;
  return vkGetBufferDeviceAddress(device_->handle(), &info);
}

bool Buffer::reserve(VkDeviceSize bytes) {
  FB_CHECK(device_ != nullptr);
  if (bytes <= size_) return false;
  // Room to grow, but not beyond what the device binds, mapped memory too: what is needed may still fit.
  const VkDeviceSize roomy = std::min(size_ + size_ / 2, largest_buffer(*device_, BufferUse::kStorage));
  *this = Buffer(*device_, use_, std::max(bytes, roomy), name_);
  return true;
}

void upload_now(Device& device, Buffer& target, const void* data, VkDeviceSize bytes, VkDeviceSize offset) {
  if (bytes == 0) return;
  FB_CHECK_LE(offset, target.size());
  FB_CHECK_LE(bytes, target.size() - offset);
  if (target.mapped()) {
    std::memcpy(static_cast<std::uint8_t*>(target.mapped()) + offset, data, bytes);
    return;
  }
  Buffer& staging = device.impl().upload_staging;
  if (!staging) staging = Buffer(device, BufferUse::kUpload, kStagingBytes, "upload staging");
  for (VkDeviceSize done = 0; done < bytes;) {
    const VkDeviceSize part = std::min(bytes - done, staging.size());
    std::memcpy(staging.mapped(), static_cast<const std::uint8_t*>(data) + done, part);
    device.run([&](Commands& commands) { commands.copy(staging, target, part, 0, offset + done); });
    done += part;
  }
}

void read_now(Device& device, const Buffer& source, void* data, VkDeviceSize bytes, VkDeviceSize offset) {
  if (bytes == 0) return;
  FB_CHECK_LE(offset, source.size());
  FB_CHECK_LE(bytes, source.size() - offset);
  if (source.mapped()) {
    std::memcpy(data, static_cast<const std::uint8_t*>(source.mapped()) + offset, bytes);
    return;
  }
  Buffer& staging = device.impl().readback_staging;
  if (!staging) staging = Buffer(device, BufferUse::kReadback, kStagingBytes, "readback staging");
  for (VkDeviceSize done = 0; done < bytes;) {
    const VkDeviceSize part = std::min(bytes - done, staging.size());
    device.run([&](Commands& commands) { commands.copy(source, staging, part, offset + done, 0); });
    std::memcpy(static_cast<std::uint8_t*>(data) + done, staging.mapped(), part);
    done += part;
  }
}

}  // namespace fb::gpu
