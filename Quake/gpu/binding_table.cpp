// Descriptors are written when something changed, always in one call, always while no submission is under way.
#include "gpu/binding_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/out_of_memory.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

using namespace shared;

constexpr std::array<std::uint32_t, kSetCount> kArrays{kSceneArrays, kFrameArrays, kTechniqueArrays, kPoseArrays,
                                                       kDrawArrays};
constexpr std::array<std::uint32_t, kSetCount> kFirstAddress{
    kFirstSceneAddress, kFirstFrameAddress, kFirstTechniqueAddress, kFirstPoseAddress, kFirstDrawAddress};
static_assert(kArraysInPlace <= 32);  // storage buffers a stage
static_assert(kPoseArrays <= kTechniqueArrays && kDrawArrays <= kTechniqueArrays);
static_assert(kTexelsTechnique + kTechniqueArrays == kTexelBuffers);

// Where shaders see a set.
constexpr std::uint32_t place_of(std::uint32_t set) { return std::min(set, kSetTechnique); }
constexpr std::uint32_t kLargestUniform = 16384;

struct Slot {
  VkBuffer buffer = VK_NULL_HANDLE;
  std::uint64_t serial = 0;
  bool dirty = true;

  // Whether it changed.
  bool set(VkBuffer handle, std::uint64_t new_serial) {
    if (serial == new_serial && buffer == handle) return false;
    *this = {handle, new_serial, true};
    return true;
  }
};

// A uniform block: where it is bound.
struct UniformPlace {
  std::uint32_t set, binding;
};
constexpr std::array kUniforms{UniformPlace{kSetScene, kBindFrameConstants},
                               UniformPlace{kSetScene, kBindTechniqueConstants},
                               UniformPlace{kSetScene, kBindAddresses}};
constexpr std::size_t kAddressUniform = 2;

VkDescriptorSetLayoutBinding compute_binding(std::uint32_t binding, VkDescriptorType type) {
  VkDescriptorSetLayoutBinding info{};
  info.binding = binding;
  info.descriptorType = type;
  info.descriptorCount = 1;
  info.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
  return info;
}

VkDescriptorSetLayout make_place_layout(VkDevice device, std::uint32_t set, bool has_tlas) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (std::uint32_t i = 0; i < kArrays[set]; ++i)
    bindings.push_back(compute_binding(i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER));
  for (const UniformPlace& uniform : kUniforms)
    if (uniform.set == set) bindings.push_back(compute_binding(uniform.binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER));
  if (set == kSetScene) {
    if (has_tlas) bindings.push_back(compute_binding(kBindTlas, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR));
    for (std::uint32_t i = 0; i < kTexelBuffers; ++i)
      bindings.push_back(compute_binding(kBindTexelBuffers + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER));
  }
  auto info = vk_struct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  FB_VK(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout));
  return layout;
}

}  // namespace

struct BindingTable::Impl {
  explicit Impl(Device& d)
      : device(d),
        unset_storage(d, BufferUse::kStorage, 256, "unset storage buffer"),
        unset_uniform(d, BufferUse::kUniform, kLargestUniform, "unset uniform buffer"),
        addresses(d, BufferUse::kUniform, kAddresses * sizeof(uvec4), "array addresses") {}
  ~Impl();
  void make_layout();
  void make_sets();
  void make_views();
  void write_addresses();

  Device& device;
  Buffer unset_storage, unset_uniform, addresses;
  std::array<std::vector<Slot>, kSetCount> arrays;
  std::array<Slot, kUniforms.size()> uniforms;
  std::array<Slot, kTexelBuffers> texels;
  std::array<VkBufferView, kTexelBuffers> views{};
  VkAccelerationStructureKHR tlas = VK_NULL_HANDLE;
  bool tlas_dirty = false, dirty = true;
  std::array<VkDescriptorSetLayout, kSetPlaces> place_layouts{};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  std::array<VkDescriptorSet, kSetCount> sets{};
};

BindingTable::Impl::~Impl() {
  const VkDevice handle = device.handle();
  for (VkBufferView view : views) vkDestroyBufferView(handle, view, nullptr);
  vkDestroyDescriptorPool(handle, pool, nullptr);
  vkDestroyPipelineLayout(handle, layout, nullptr);
  for (VkDescriptorSetLayout place_layout : place_layouts) vkDestroyDescriptorSetLayout(handle, place_layout, nullptr);
}

void BindingTable::Impl::make_layout() {
  for (std::uint32_t place = 0; place < kSetPlaces; ++place)
    place_layouts[place] = make_place_layout(device.handle(), place, device.has_ray_query());
  VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, kPushConstantBytes};
  auto info = vk_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = kSetPlaces;
  info.pSetLayouts = place_layouts.data();
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &push;
  FB_VK(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout));
}

void BindingTable::Impl::make_sets() {
  constexpr std::uint32_t kInThirdPlace = kSetCount - kSetTechnique;
  std::array<VkDescriptorSetLayout, kSetCount> set_layouts;
  for (std::uint32_t set = 0; set < kSetCount; ++set) set_layouts[set] = place_layouts[place_of(set)];
  const VkDescriptorPoolSize sizes[] = {
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSceneArrays + kFrameArrays + kInThirdPlace * kTechniqueArrays},
      {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, static_cast<std::uint32_t>(kUniforms.size())},
      {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, kTexelBuffers},
      {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1}};
  auto info = vk_struct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  info.maxSets = kSetCount;
  info.poolSizeCount = device.has_ray_query() ? 4 : 3;
  info.pPoolSizes = sizes;
  FB_VK(vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool));
  auto allocate = vk_struct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate.descriptorPool = pool;
  allocate.descriptorSetCount = kSetCount;
  allocate.pSetLayouts = set_layouts.data();
  FB_VK(vkAllocateDescriptorSets(device.handle(), &allocate, sets.data()));
}

// Views of texel buffers that changed, each in the place of the former one.
void BindingTable::Impl::make_views() {
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i) {
    if (!texels[i].dirty) continue;
    auto info = vk_struct<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
    info.buffer = texels[i].buffer;
    info.format = VK_FORMAT_R32G32B32A32_UINT;
    info.range = VK_WHOLE_SIZE;
    VkBufferView view = VK_NULL_HANDLE;
    FB_VK(vkCreateBufferView(device.handle(), &info, nullptr, &view));
    vkDestroyBufferView(device.handle(), std::exchange(views[i], view), nullptr);
  }
}

// Addresses of arrays that changed.
void BindingTable::Impl::write_addresses() {
  if (!device.has_addresses()) return;
  const auto words = addresses.mapped_as<uvec4>();
  for (std::uint32_t set = 0; set < kSetCount; ++set) {
    for (std::uint32_t i = 0; i < kArrays[set]; ++i) {
      if (!arrays[set][i].dirty) continue;
      auto info = vk_struct<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
      info.buffer = arrays[set][i].buffer;
      const VkDeviceAddress address = vkGetBufferDeviceAddress(device.handle(), &info);
      words[kFirstAddress[set] + i] =
          uvec4(static_cast<std::uint32_t>(address), static_cast<std::uint32_t>(address >> 32), 0, 0);
    }
  }
}

BindingTable::BindingTable(Device& device) : impl_(std::make_unique<Impl>(device)) {
  std::memset(impl_->unset_uniform.mapped(), 0, kLargestUniform);  // what is not set is 0, and no chance
  impl_->make_layout();
  impl_->make_sets();
  for (std::uint32_t set = 0; set < kSetCount; ++set)
    impl_->arrays[set].assign(kArrays[set], Slot{impl_->unset_storage.handle()});
  for (Slot& slot : impl_->uniforms) slot.buffer = impl_->unset_uniform.handle();
  impl_->uniforms[kAddressUniform].buffer = impl_->addresses.handle();
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i) set_texels(i, impl_->unset_storage);
}

BindingTable::~BindingTable() = default;

void BindingTable::set_array(std::uint32_t set, std::uint32_t binding, const Buffer& buffer) {
  FB_CHECK_LT(set, kSetCount);
  FB_CHECK_LT(binding, kArrays[set]);
  const Device& device = impl_->device;
  if (buffer && buffer.size() > device.limits().max_storage_buffer_range)
    throw OutOfMemory(fmt::format("\"{}\" needs a buffer of {}; {} binds {} at most", buffer.name(),
                                  memory_text(buffer.size()), device.report().name,
                                  memory_text(device.limits().max_storage_buffer_range)));
  impl_->dirty |=
      impl_->arrays[set][binding].set(buffer ? buffer.handle() : impl_->unset_storage.handle(), buffer.serial());
  if (set == kSetTechnique) set_texels(kTexelsTechnique + binding, buffer);
}

void BindingTable::set_uniform(std::uint32_t set, const Buffer& buffer) {
  FB_CHECK(set == kSetScene || set == kSetTechnique);  // of the frame, of the technique
  Slot& slot = impl_->uniforms[set == kSetScene ? 0 : 1];
  impl_->dirty |= slot.set(buffer ? buffer.handle() : impl_->unset_uniform.handle(), buffer.serial());
}

void BindingTable::set_texels(std::uint32_t index, const Buffer& buffer) {
  FB_CHECK_LT(index, kTexelBuffers);
  const Buffer& seen = buffer ? buffer : impl_->unset_storage;
  impl_->dirty |= impl_->texels[index].set(seen.handle(), seen.serial());
}

void BindingTable::set_tlas(VkAccelerationStructureKHR tlas) {
  FB_CHECK(impl_->device.has_ray_query());
  impl_->tlas = tlas;
  // Written again even if the handle is the same: a structure made anew may have got the old one's.
  impl_->tlas_dirty = tlas != VK_NULL_HANDLE;
  impl_->dirty |= impl_->tlas_dirty;
}

void BindingTable::flush() const {
  Impl& table = *impl_;
  if (!table.dirty) return;
  // What may fail comes first: what is dirty stays so until it is written.
  table.make_views();
  table.write_addresses();
  std::vector<VkDescriptorBufferInfo> infos;
  std::vector<VkWriteDescriptorSet> writes;
  infos.reserve(kAddresses + kUniforms.size());  // the writes point into it
  writes.reserve(infos.capacity() + kTexelBuffers + 1);
  const auto write = [&](std::uint32_t set, std::uint32_t binding, VkDescriptorType type) -> VkWriteDescriptorSet& {
    auto out = vk_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    out.dstSet = table.sets[set];
    out.dstBinding = binding;
    out.descriptorCount = 1;
    out.descriptorType = type;
    return writes.emplace_back(out);
  };
  const auto write_buffer = [&](Slot& slot, std::uint32_t set, std::uint32_t binding, VkDescriptorType type) {
    if (!std::exchange(slot.dirty, false)) return;
    infos.push_back({slot.buffer, 0, VK_WHOLE_SIZE});
    write(set, binding, type).pBufferInfo = &infos.back();
  };
  for (std::uint32_t set = 0; set < kSetCount; ++set)
    for (std::uint32_t i = 0; i < kArrays[set]; ++i)
      write_buffer(table.arrays[set][i], set, i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  for (std::size_t i = 0; i < kUniforms.size(); ++i)
    write_buffer(table.uniforms[i], kUniforms[i].set, kUniforms[i].binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i) {
    if (!std::exchange(table.texels[i].dirty, false)) continue;
    write(kSetScene, kBindTexelBuffers + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER).pTexelBufferView = &table.views[i];
  }
  auto structure = vk_struct<VkWriteDescriptorSetAccelerationStructureKHR>(
      VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR);
  if (std::exchange(table.tlas_dirty, false)) {
    structure.accelerationStructureCount = 1;
    structure.pAccelerationStructures = &table.tlas;
    write(kSetScene, kBindTlas, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR).pNext = &structure;
  }
  table.dirty = false;
  vkUpdateDescriptorSets(table.device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

VkPipelineLayout BindingTable::layout() const { return impl_->layout; }
const std::array<VkDescriptorSet, kSetCount>& BindingTable::sets() const { return impl_->sets; }

}  // namespace fb::gpu
