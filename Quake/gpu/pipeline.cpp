#include "gpu/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/hash.h"
#include "base/out_of_memory.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {

namespace {

// More than a frame of every estimator has.
constexpr std::size_t kKept = 64;

std::uint64_t key_of(std::span<const std::uint32_t> spirv, std::span<const SpecializationConstant> constants) {
  return hash_bytes(constants.data(), constants.size_bytes(), hash_bytes(spirv.data(), spirv.size_bytes()));
}

void make(MadePipeline& made, Device& device, const BindingTable& table, std::span<const std::uint32_t> spirv,
          const std::string& name, std::span<const SpecializationConstant> constants) {
  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < constants.size(); ++i)
    entries.push_back(
        {constants[i].id,
         static_cast<std::uint32_t>(i * sizeof(SpecializationConstant) + offsetof(SpecializationConstant, value)),
         sizeof(std::uint32_t)});
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<std::uint32_t>(entries.size());
  specialization.pMapEntries = entries.data();
  specialization.dataSize = constants.size_bytes();
  specialization.pData = constants.data();

  device.impl().leave_driver_room();
  auto module_info = vk_struct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  FB_VK(vkCreateShaderModule(device.handle(), &module_info, nullptr, &module));

  auto info = vk_struct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = table.layout();
  const VkResult result =
      FB_VK_TRY(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &made.pipeline));
  vkDestroyShaderModule(device.handle(), module, nullptr);
  if (is_out_of_memory(result))
    throw OutOfMemory(fmt::format("{} is out of memory: it cannot compile shader \"{}\" ({})", device.report().name,
                                  name, result_name(result)));
  if (result != VK_SUCCESS)
    fatal(__FILE__, __LINE__,
          fmt::format("{} does not compile shader \"{}\": {}", device.report().name, name, result_name(result)));
  device.impl().set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(made.pipeline), name);
}

}  // namespace

std::shared_ptr<const MadePipeline> SharedPipelines::find(std::uint64_t key) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const auto& made) { return made->key == key; });
  if (found == list_.end()) return nullptr;
  std::rotate(found, found + 1, list_.end());
  return list_.back();
}

void SharedPipelines::keep(std::shared_ptr<const MadePipeline> made) {
  const std::lock_guard lock(mutex_);
  if (list_.size() >= kKept) list_.erase(list_.begin());
  list_.push_back(std::move(made));
}

ComputePipeline::ComputePipeline(Device& device, const BindingTable& table, std::span<const std::uint32_t> spirv,
                                 std::string name, std::span<const SpecializationConstant> constants)
    : name_(std::move(name)) {
  const bool shares = device.options().shares_pipelines;
  const std::uint64_t key = key_of(spirv, constants);
  if (shares) made_ = device.impl().pipelines.find(key);
  if (made_) return;
  auto made = std::make_shared<MadePipeline>(device.handle(), key);
  make(*made, device, table, spirv, name_, constants);
  made_ = std::move(made);
  if (shares) device.impl().pipelines.keep(made_);
}

VkPipeline ComputePipeline::handle() const { return made_ ? made_->pipeline : VK_NULL_HANDLE; }

}  // namespace fb::gpu
