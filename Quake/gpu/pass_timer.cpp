// Timestamps before and after each pass. Both are taken when all earlier work has ended, so that passes which a barrier
// separates do not count each other's time.
#include "base/check.h"
#include "gpu/commands.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {

struct PassTimer::Impl {
  explicit Impl(Device& d) : device(d) {}
  Device& device;
  VkQueryPool pool = VK_NULL_HANDLE;  // null: the device has no timestamps
  std::uint32_t capacity = 0;
  std::vector<std::string> names;   // since the last reset; pass i has queries 2i and 2i+1
  std::vector<std::uint32_t> open;  // passes begun and not ended, outermost first
};

PassTimer::PassTimer(Device& device, std::uint32_t max_passes) : impl_(std::make_unique<Impl>(device)) {
  impl_->capacity = max_passes;
  if (device.limits().timestamp_period_ns <= 0 || max_passes == 0) return;
  auto info = vk_struct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2 * max_passes;
  FB_VK(vkCreateQueryPool(device.handle(), &info, nullptr, &impl_->pool));
}

PassTimer::~PassTimer() {
  if (impl_->pool) vkDestroyQueryPool(impl_->device.handle(), impl_->pool, nullptr);
}

void PassTimer::reset(VkCommandBuffer cmd) {
  FB_CHECK(impl_->open.empty());
  impl_->names.clear();
  if (impl_->pool) vkCmdResetQueryPool(cmd, impl_->pool, 0, 2 * impl_->capacity);
}

void PassTimer::begin(VkCommandBuffer cmd, std::string_view name) {
  const auto pass = static_cast<std::uint32_t>(impl_->names.size());
  FB_CHECK_LT(pass, impl_->capacity);
  impl_->names.emplace_back(name);
  impl_->open.push_back(pass);
  if (impl_->pool) vkCmdWriteTimestamp(cmd, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, impl_->pool, 2 * pass);
}

void PassTimer::end(VkCommandBuffer cmd) {
  FB_CHECK(!impl_->open.empty());
  const std::uint32_t pass = impl_->open.back();
  impl_->open.pop_back();
  if (impl_->pool) vkCmdWriteTimestamp(cmd, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, impl_->pool, 2 * pass + 1);
}

std::vector<PassTime> PassTimer::read() {
  FB_CHECK(impl_->open.empty());
  std::vector<PassTime> times;
  for (const std::string& name : impl_->names) times.push_back({name, 0.0});
  if (!impl_->pool || times.empty()) return times;
  std::vector<std::uint64_t> stamps(2 * times.size());
  FB_VK(vkGetQueryPoolResults(impl_->device.handle(), impl_->pool, 0, static_cast<std::uint32_t>(stamps.size()),
                              stamps.size() * sizeof(std::uint64_t), stamps.data(), sizeof(std::uint64_t),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  // Only so many bits of a stamp count, and they wrap.
  const std::uint32_t bits = impl_->device.impl().timestamp_bits;
  const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const double milliseconds = static_cast<double>(impl_->device.limits().timestamp_period_ns) * 1e-6;
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i].milliseconds = static_cast<double>((stamps[2 * i + 1] - stamps[2 * i]) & mask) * milliseconds;
  return times;
}

}  // namespace fb::gpu
