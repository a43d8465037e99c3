// Timestamps at the edges of passes, each taken when all earlier work has ended, so that passes which a barrier
// separates do not count each other's time. A pass that follows another starts from that one's end: a timestamp costs
// lavapipe some 50 microseconds, and whatever is recorded between two passes is counted with the later one instead of
// nowhere.
#include "base/check.h"
#include "gpu/commands.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {

struct PassTimer::Impl {
  struct Pass {
    std::string name;
    std::uint32_t begin_stamp, end_stamp;  // queries
  };
  explicit Impl(Device& d) : device(d) {}
  std::uint32_t stamp(VkCommandBuffer cmd) {
    if (pool) vkCmdWriteTimestamp(cmd, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, stamps);
    return stamps++;
  }

  Device& device;
  VkQueryPool pool = VK_NULL_HANDLE;  // null: the device has no timestamps
  std::uint32_t capacity = 0;
  std::uint32_t stamps = 0;         // written since the last reset
  std::vector<Pass> passes;         // begun since the last reset
  std::vector<std::uint32_t> open;  // passes begun and not ended, outermost first
  bool just_ended = false;          // the last stamp is a pass's end
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
  impl_->passes.clear();
  impl_->stamps = 0;
  impl_->just_ended = false;
  if (impl_->pool) vkCmdResetQueryPool(cmd, impl_->pool, 0, 2 * impl_->capacity);
}

void PassTimer::begin(VkCommandBuffer cmd, std::string_view name) {
  const auto pass = static_cast<std::uint32_t>(impl_->passes.size());
  FB_CHECK_LT(pass, impl_->capacity);
  const std::uint32_t stamp = impl_->just_ended ? impl_->stamps - 1 : impl_->stamp(cmd);
  impl_->just_ended = false;
  impl_->passes.push_back({std::string(name), stamp, stamp});
  impl_->open.push_back(pass);
}

void PassTimer::end(VkCommandBuffer cmd) {
  FB_CHECK(!impl_->open.empty());
  impl_->passes[impl_->open.back()].end_stamp = impl_->stamp(cmd);
  impl_->open.pop_back();
  impl_->just_ended = true;
}

std::vector<PassTime> PassTimer::read() {
  FB_CHECK(impl_->open.empty());
  std::vector<PassTime> times;
  for (const Impl::Pass& pass : impl_->passes) times.push_back({pass.name, 0.0});
  if (!impl_->pool || times.empty()) return times;
  std::vector<std::uint64_t> stamps(impl_->stamps);
  FB_VK(vkGetQueryPoolResults(impl_->device.handle(), impl_->pool, 0, impl_->stamps,
                              stamps.size() * sizeof(std::uint64_t), stamps.data(), sizeof(std::uint64_t),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  // Only so many bits of a stamp count, and they wrap.
  const std::uint32_t bits = impl_->device.impl().timestamp_bits;
  const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const double milliseconds = static_cast<double>(impl_->device.limits().timestamp_period_ns) * 1e-6;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Impl::Pass& pass = impl_->passes[i];
    times[i].milliseconds =
        static_cast<double>((stamps[pass.end_stamp] - stamps[pass.begin_stamp]) & mask) * milliseconds;
  }
  return times;
}

}  // namespace fb::gpu
