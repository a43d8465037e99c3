#include "gpu/pipeline.h"

#include <fmt/format.h>

#include <utility>

#include "base/check.h"
#include "base/out_of_memory.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {

ComputePipeline::ComputePipeline(Device& device, const BindingTable& table, std::span<const std::uint32_t> spirv,
                                 std::string name, std::span<const SpecializationConstant> constants)
    : ComputePipeline() {  // delegates, so that the pipeline is given back if something throws behind it
  device_ = &device;
  name_ = std::move(name);
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
      FB_VK_TRY(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_));
  vkDestroyShaderModule(device.handle(), module, nullptr);
  if (is_out_of_memory(result))
    throw OutOfMemory(fmt::format("{} is out of memory: it cannot compile shader \"{}\" ({})", device.report().name,
                                  name_, result_name(result)));
  if (result != VK_SUCCESS)
    fatal(__FILE__, __LINE__,
          fmt::format("{} does not compile shader \"{}\": {}", device.report().name, name_, result_name(result)));
  device.impl().set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline_), name_);
}

ComputePipeline::~ComputePipeline() {
  if (device_) vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
}

ComputePipeline::ComputePipeline(ComputePipeline&& other) noexcept { *this = std::move(other); }

ComputePipeline& ComputePipeline::operator=(ComputePipeline&& other) noexcept {
  if (this == &other) return *this;
  if (device_) vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
  device_ = std::exchange(other.device_, nullptr);
  pipeline_ = std::exchange(other.pipeline_, VK_NULL_HANDLE);
  name_ = std::move(other.name_);
  return *this;
}

}  // namespace fb::gpu
