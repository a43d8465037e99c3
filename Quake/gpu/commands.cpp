#include "gpu/commands.h"

#include <fmt/format.h>

#include "base/check.h"
#include "base/out_of_memory.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {

void Commands::bind(const BindingTable& table) {
  table.flush();
  layout_ = table.layout();
  vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, shared::kSetPlaces, table.sets().data(), 0,
                          nullptr);
}

void Commands::bind_third(const BindingTable& table, std::uint32_t set) {
  FB_CHECK(layout_ == table.layout());
  FB_CHECK(set >= shared::kSetTechnique && set < shared::kSetCount);
  vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, shared::kSetTechnique, 1, &table.sets()[set],
                          0, nullptr);
}

void Commands::push_bytes(const void* data, std::uint32_t bytes) {
  FB_CHECK(layout_ != VK_NULL_HANDLE);  // bind() comes first
  FB_CHECK_EQ(bytes % 4, 0u);
  vkCmdPushConstants(cmd_, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, bytes, data);
}

// To run so many workgroups at most.
void Commands::bind(const ComputePipeline& pipeline, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  FB_CHECK(layout_ != VK_NULL_HANDLE);  // bind() comes first
  FB_CHECK(pipeline);
  const auto& most = device_.limits().max_workgroups;
  if (x > most[0] || y > most[1] || z > most[2])
    throw OutOfMemory(fmt::format("\"{}\" has {}x{}x{} workgroups to run; {} takes {}x{}x{} at a time", pipeline.name(),
                                  x, y, z, device_.report().name, most[0], most[1], most[2]));
  vkCmdBindPipeline(cmd_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
}

void Commands::dispatch(const ComputePipeline& pipeline, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  bind(pipeline, x, y, z);
  vkCmdDispatch(cmd_, x, y, z);
}

void Commands::dispatch_indirect(const ComputePipeline& pipeline, const Buffer& groups, VkDeviceSize offset,
                                 std::uint32_t x, std::uint32_t y) {
  FB_CHECK_LE(offset + sizeof(VkDispatchIndirectCommand), groups.size());
  bind(pipeline, x, y, 1);
  vkCmdDispatchIndirect(cmd_, groups.handle(), offset);
}

void Commands::barrier() {
  auto all = vk_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  all.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  all.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vkCmdPipelineBarrier(cmd_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &all, 0,
                       nullptr, 0, nullptr);
}

void Commands::copy(const Buffer& from, const Buffer& to, VkDeviceSize bytes, VkDeviceSize from_offset,
                    VkDeviceSize to_offset) {
  if (bytes == 0) return;
  FB_CHECK_LE(from_offset, from.size());
  FB_CHECK_LE(bytes, from.size() - from_offset);
  FB_CHECK_LE(to_offset, to.size());
  FB_CHECK_LE(bytes, to.size() - to_offset);
  const VkBufferCopy region{from_offset, to_offset, bytes};
  vkCmdCopyBuffer(cmd_, from.handle(), to.handle(), 1, &region);
}

void Commands::fill(const Buffer& buffer, std::uint32_t value, VkDeviceSize offset, VkDeviceSize bytes) {
  vkCmdFillBuffer(cmd_, buffer.handle(), offset, bytes, value);
}

void Commands::update(const Buffer& buffer, std::span<const std::uint32_t> words, VkDeviceSize offset) {
  FB_CHECK_LE(offset + words.size_bytes(), buffer.size());
  vkCmdUpdateBuffer(cmd_, buffer.handle(), offset, words.size_bytes(), words.data());
}

Commands::Scope::Scope(Commands& commands, std::string_view name) : commands_(commands) {
  const DebugCalls& debug = commands.device_.impl().debug;
  if (debug.begin_label) {
    const std::string text(name);
    auto label = vk_struct<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = text.c_str();
    debug.begin_label(commands.cmd_, &label);
  }
  if (commands.timer_) commands.timer_->begin(commands.cmd_, name);
}

Commands::Scope::~Scope() {
  if (commands_.timer_) commands_.timer_->end(commands_.cmd_);
  const DebugCalls& debug = commands_.device_.impl().debug;
  if (debug.end_label) debug.end_label(commands_.cmd_);
}

}  // namespace fb::gpu
