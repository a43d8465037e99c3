// The two descriptor sets. Descriptors are written when something changed, always in one call, always while no
// submission is under way.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/out_of_memory.h"
#include "gpu/device_impl.h"
#include "gpu/pipeline.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

struct Slot {
  VkBuffer buffer = VK_NULL_HANDLE;
  std::uint64_t serial = 0;
  bool dirty = true;
};

VkDescriptorSetLayoutBinding compute_binding(std::uint32_t binding, VkDescriptorType type) {
  VkDescriptorSetLayoutBinding info{};
  info.binding = binding;
  info.descriptorType = type;
  info.descriptorCount = 1;
  info.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
  return info;
}

VkDescriptorSetLayout make_set_layout(VkDevice device, const std::vector<VkDescriptorSetLayoutBinding>& bindings) {
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
        unset_uniform(d, BufferUse::kUniform, 16384, "unset uniform buffer") {}
  ~Impl();

  void set(Slot& slot, const Buffer& buffer) {
    const VkBuffer handle = buffer ? buffer.handle() : unset_storage.handle();
    if (buffer && buffer.size() > device.limits().max_storage_buffer_range)
      throw OutOfMemory(fmt::format("\"{}\" needs a buffer of {}; {} binds {} at most", buffer.name(),
                                    memory_text(buffer.size()), device.report().name,
                                    memory_text(device.limits().max_storage_buffer_range)));
    if (slot.serial == buffer.serial() && slot.buffer == handle) return;
    slot = {handle, buffer.serial(), true};
    dirty = true;
  }

  Device& device;
  Buffer unset_storage, unset_uniform;
  std::array<Slot, kSceneBuffers> scene;
  std::array<Slot, kFrameBuffers> frame;
  Slot uniform;
  std::array<Slot, kTexelBuffers> texels;
  std::array<VkDeviceSize, kTexelBuffers> texel_bytes{};
  std::array<VkBufferView, kTexelBuffers> views{};
  VkAccelerationStructureKHR tlas = VK_NULL_HANDLE;
  bool tlas_dirty = false, dirty = true;
  std::array<VkDescriptorSetLayout, 2> set_layouts{};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  std::array<VkDescriptorSet, 2> sets{};

  void make_views();
};

BindingTable::Impl::~Impl() {
  const VkDevice handle = device.handle();
  for (VkBufferView view : views) vkDestroyBufferView(handle, view, nullptr);
  vkDestroyDescriptorPool(handle, pool, nullptr);
  vkDestroyPipelineLayout(handle, layout, nullptr);
  for (VkDescriptorSetLayout set_layout : set_layouts) vkDestroyDescriptorSetLayout(handle, set_layout, nullptr);
}

// Views of texel buffers that changed, each in the place of the former one.
void BindingTable::Impl::make_views() {
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i) {
    if (!texels[i].dirty) continue;
    auto info = vk_struct<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
    info.buffer = texels[i].buffer;
    info.format = VK_FORMAT_R32G32B32A32_UINT;
    info.range = texel_bytes[i];
    VkBufferView view = VK_NULL_HANDLE;
    FB_VK(vkCreateBufferView(device.handle(), &info, nullptr, &view));
    vkDestroyBufferView(device.handle(), std::exchange(views[i], view), nullptr);
  }
}

BindingTable::BindingTable(Device& device) : impl_(std::make_unique<Impl>(device)) {
  const VkDevice handle = device.handle();
  const bool has_tlas = device.has_ray_query();
  std::vector<VkDescriptorSetLayoutBinding> scene, frame;
  for (std::uint32_t i = 0; i < kSceneBuffers; ++i)
    scene.push_back(compute_binding(i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER));
  scene.push_back(compute_binding(kUniformBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER));
  if (has_tlas) scene.push_back(compute_binding(kTlasBinding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR));
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i)
    scene.push_back(compute_binding(kTexelBinding + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER));
  for (std::uint32_t i = 0; i < kFrameBuffers; ++i)
    frame.push_back(compute_binding(i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER));
  impl_->set_layouts[0] = make_set_layout(handle, scene);
  impl_->set_layouts[1] = make_set_layout(handle, frame);

  VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, kPushConstantBytes};
  auto layout = vk_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = 2;
  layout.pSetLayouts = impl_->set_layouts.data();
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &push;
  FB_VK(vkCreatePipelineLayout(handle, &layout, nullptr, &impl_->layout));

  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSceneBuffers + kFrameBuffers},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, kTexelBuffers},
                                        {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1}};
  auto pool = vk_struct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.maxSets = 2;
  pool.poolSizeCount = has_tlas ? 4 : 3;
  pool.pPoolSizes = sizes;
  FB_VK(vkCreateDescriptorPool(handle, &pool, nullptr, &impl_->pool));
  auto allocate = vk_struct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate.descriptorPool = impl_->pool;
  allocate.descriptorSetCount = 2;
  allocate.pSetLayouts = impl_->set_layouts.data();
  FB_VK(vkAllocateDescriptorSets(handle, &allocate, impl_->sets.data()));

  for (Slot& slot : impl_->scene) slot.buffer = impl_->unset_storage.handle();
  for (Slot& slot : impl_->frame) slot.buffer = impl_->unset_storage.handle();
  impl_->uniform.buffer = impl_->unset_uniform.handle();
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i) set_texels(i, impl_->unset_storage);
}

BindingTable::~BindingTable() = default;

void BindingTable::set_scene(std::uint32_t binding, const Buffer& buffer) {
  FB_CHECK_LT(binding, kSceneBuffers);
  impl_->set(impl_->scene[binding], buffer);
}

void BindingTable::set_frame(std::uint32_t binding, const Buffer& buffer) {
  FB_CHECK_LT(binding, kFrameBuffers);
  impl_->set(impl_->frame[binding], buffer);
}

void BindingTable::set_uniform(const Buffer& buffer) {
  const VkBuffer handle = buffer ? buffer.handle() : impl_->unset_uniform.handle();
  if (impl_->uniform.serial == buffer.serial() && impl_->uniform.buffer == handle) return;
  impl_->uniform = {handle, buffer.serial(), true};
  impl_->dirty = true;
}

void BindingTable::set_texels(std::uint32_t index, const Buffer& buffer) {
  FB_CHECK_LT(index, kTexelBuffers);
  const Buffer& seen = buffer ? buffer : impl_->unset_storage;
  Slot& slot = impl_->texels[index];
  if (slot.serial == seen.serial() && slot.buffer == seen.handle()) return;
  slot = {seen.handle(), seen.serial(), true};
  impl_->texel_bytes[index] = std::min(seen.size(), impl_->device.limits().max_texel_buffer_bytes);
  impl_->dirty = true;
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
  std::vector<VkDescriptorBufferInfo> infos;
  std::vector<VkWriteDescriptorSet> writes;
  infos.reserve(kSceneBuffers + kFrameBuffers + 1);  // the writes point into it
  writes.reserve(infos.capacity() + kTexelBuffers + 1);
  const auto write = [&](Slot& slot, VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type) {
    if (!slot.dirty) return;
    slot.dirty = false;
    infos.push_back({slot.buffer, 0, VK_WHOLE_SIZE});
    auto out = vk_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    out.dstSet = set;
    out.dstBinding = binding;
    out.descriptorCount = 1;
    out.descriptorType = type;
    out.pBufferInfo = &infos.back();
    writes.push_back(out);
  };
  for (std::uint32_t i = 0; i < kSceneBuffers; ++i)
    write(table.scene[i], table.sets[0], i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  for (std::uint32_t i = 0; i < kFrameBuffers; ++i)
    write(table.frame[i], table.sets[1], i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  write(table.uniform, table.sets[0], kUniformBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
  auto structure = vk_struct<VkWriteDescriptorSetAccelerationStructureKHR>(
      VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR);
  for (std::uint32_t i = 0; i < kTexelBuffers; ++i) {
    if (!table.texels[i].dirty) continue;
    table.texels[i].dirty = false;
    auto out = vk_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    out.dstSet = table.sets[0];
    out.dstBinding = kTexelBinding + i;
    out.descriptorCount = 1;
    out.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    out.pTexelBufferView = &table.views[i];
    writes.push_back(out);
  }
  if (table.tlas_dirty) {
    table.tlas_dirty = false;
    structure.accelerationStructureCount = 1;
    structure.pAccelerationStructures = &table.tlas;
    auto out = vk_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    out.pNext = &structure;
    out.dstSet = table.sets[0];
    out.dstBinding = kTlasBinding;
    out.descriptorCount = 1;
    out.descriptorType = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    writes.push_back(out);
  }
  table.dirty = false;
  vkUpdateDescriptorSets(table.device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

VkPipelineLayout BindingTable::layout() const { return impl_->layout; }
std::array<VkDescriptorSet, 2> BindingTable::sets() const { return impl_->sets; }

}  // namespace fb::gpu
