#include "gpu/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/out_of_memory.h"
#include "base/system.h"
#include "gpu/commands.h"
#include "gpu/device_choice.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

template <typename Call>
void load(VkDevice device, const char* name, Call& call) {
  call = reinterpret_cast<Call>(vkGetDeviceProcAddr(device, name));
  if (!call) fatal(__FILE__, __LINE__, fmt::format("Vulkan: the driver offers its extension without {}", name));
}

void load_acceleration_structure_calls(VkDevice device, AccelerationStructureCalls& calls) {
  load(device, "vkCreateAccelerationStructureKHR", calls.create);
  load(device, "vkDestroyAccelerationStructureKHR", calls.destroy);
  load(device, "vkGetAccelerationStructureBuildSizesKHR", calls.build_sizes);
  load(device, "vkGetAccelerationStructureDeviceAddressKHR", calls.address);
  load(device, "vkCmdBuildAccelerationStructuresKHR", calls.build);
}

void load_debug_calls(VkInstance instance, DebugCalls& calls) {
  calls.set_name = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
      vkGetInstanceProcAddr(instance, "vkSetDebugUtilsObjectNameEXT"));
  calls.begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
      vkGetInstanceProcAddr(instance, "vkCmdBeginDebugUtilsLabelEXT"));
  calls.end_label =
      reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(vkGetInstanceProcAddr(instance, "vkCmdEndDebugUtilsLabelEXT"));
}

DeviceLimits read_limits(const PhysicalDevice& physical) {
  auto structure = vk_struct<VkPhysicalDeviceAccelerationStructurePropertiesKHR>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR);
  auto maintenance =
      vk_struct<VkPhysicalDeviceMaintenance3Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
  auto properties = vk_struct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties.pNext = &maintenance;
  if (physical.report.has_ray_query) maintenance.pNext = &structure;
  vkGetPhysicalDeviceProperties2(physical.handle, &properties);
  const VkPhysicalDeviceLimits& from = properties.properties.limits;
  DeviceLimits limits;
  // Large arrays are read as texels of 16 bytes, too.
  limits.max_storage_buffer_range =
      std::min<VkDeviceSize>(from.maxStorageBufferRange, VkDeviceSize{from.maxTexelBufferElements} * 16);
  limits.max_allocation_bytes = maintenance.maxMemoryAllocationSize;
  std::copy(std::begin(from.maxComputeWorkGroupCount), std::end(from.maxComputeWorkGroupCount),
            limits.max_workgroups.begin());
  limits.timestamp_period_ns = physical.timestamp_bits ? from.timestampPeriod : 0.0f;
  limits.max_workgroup_invocations = from.maxComputeWorkGroupInvocations;
  limits.min_acceleration_structure_scratch_alignment =
      std::max(1u, structure.minAccelerationStructureScratchOffsetAlignment);
  return limits;
}

VkResult make_device(const PhysicalDevice& physical, bool present, bool ray_query, VkDevice* device) {
  std::vector<const char*> extensions;
  if (present) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  auto core = vk_struct<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  auto structure = vk_struct<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
  auto query = vk_struct<VkPhysicalDeviceRayQueryFeaturesKHR>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);
  core.bufferDeviceAddress = physical.report.has_addresses;
  if (ray_query) {
    extensions.insert(extensions.end(), {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                         VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME});
    structure.accelerationStructure = VK_TRUE;
    query.rayQuery = VK_TRUE;
    core.pNext = &structure;
    structure.pNext = &query;
  }
  const float priority = 1.0f;
  auto queue = vk_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = physical.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto info = vk_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.pNext = &core;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  return FB_VK_TRY(vkCreateDevice(physical.handle, &info, nullptr, device));
}

std::vector<DeviceReport> reports_of(const std::vector<PhysicalDevice>& devices) {
  std::vector<DeviceReport> reports;
  for (const PhysicalDevice& device : devices) reports.push_back(device.report);
  return reports;
}

}  // namespace

Result<std::vector<DeviceReport>> list_devices(const DeviceOptions& options) {
  return within_memory([&]() -> Result<std::vector<DeviceReport>> {
    auto instance = Instance::create(options);
    if (!instance) return instance.error();
    std::vector<DeviceReport> reports = reports_of(examine_devices((*instance)->handle(), options));
    if (reports.empty()) return choose_device(reports, {}).error();
    if (const auto chosen = choose_device(reports, options.preferred)) reports[*chosen].would_be_chosen = true;
    return reports;
  });
}

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
  return within_memory([&] { return make(options); });
}

Result<std::unique_ptr<Device>> Device::make(const DeviceOptions& options) {
  auto instance = Instance::create(options);
  if (!instance) return instance.error();
  const std::vector<PhysicalDevice> devices = examine_devices((*instance)->handle(), options);
  const auto chosen = choose_device(reports_of(devices), options.preferred);
  if (!chosen) return chosen.error();
  const PhysicalDevice& physical = devices[*chosen];

  auto impl = std::make_unique<Impl>();
  impl->instance = std::move(*instance);
  impl->options = options;
  impl->report = physical.report;
  impl->report.would_be_chosen = true;
  impl->physical = physical.handle;
  impl->queue_family = physical.queue_family;
  impl->timestamp_bits = physical.timestamp_bits;
  impl->ray_query = options.ray_query && physical.report.has_ray_query;
  impl->limits = read_limits(physical);
  if (options.most_buffer_bytes != 0)
    impl->limits.max_storage_buffer_range = std::min(impl->limits.max_storage_buffer_range, options.most_buffer_bytes);
  vkGetPhysicalDeviceMemoryProperties(physical.handle, &impl->memory);
  for (std::uint32_t i = 0; i < impl->memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = impl->memory.memoryHeaps[i];
    if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
      impl->limits.local_memory_bytes = std::max(impl->limits.local_memory_bytes, heap.size);
  }
  impl->leave_driver_room(kRoomToStart);
  const VkResult result = make_device(physical, options.present, impl->ray_query, &impl->device);
  if (result != VK_SUCCESS)
    return Error{fmt::format("Vulkan device {} could not be opened: vkCreateDevice gave {}", physical.report.name,
                             result_name(result))};
  vkGetDeviceQueue(impl->device, impl->queue_family, 0, &impl->queue);
  if (impl->ray_query) load_acceleration_structure_calls(impl->device, impl->acceleration);
  if (impl->instance->has_debug_utils()) load_debug_calls(impl->instance->handle(), impl->debug);

  auto pool = vk_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = impl->queue_family;
  FB_VK(vkCreateCommandPool(impl->device, &pool, nullptr, &impl->pool));
  return std::unique_ptr<Device>(new Device(std::move(impl)));
}

Device::Device(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Device::~Device() {
  FB_CHECK_EQ(impl_->depth, std::size_t{0});  // not from within run()
  // They count down allocated_bytes through this device, so they go while it stands.
  impl_->upload_staging = {};
  impl_->readback_staging = {};
  impl_->no_triangle = {};
}

Device::Impl::~Impl() {
  if (!device) return;
  vkDeviceWaitIdle(device);
  pipelines.clear();
  for (const Recording& recording : recordings) vkDestroyFence(device, recording.fence, nullptr);
  vkDestroyCommandPool(device, pool, nullptr);
  vkDestroyDevice(device, nullptr);
}

void Device::Impl::leave_driver_room(std::size_t bytes) const {
  if (report.is_software && !has_room(bytes))
    throw OutOfMemory(fmt::format("the system has not the {} left that {} may need", memory_text(bytes), report.name));
}

void Device::Impl::set_name(VkObjectType type, std::uint64_t object, std::string_view name) const {
  if (!debug.set_name) return;
  const std::string text(name);
  auto info = vk_struct<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = text.c_str();
  debug.set_name(device, &info);
}

const DeviceReport& Device::report() const { return impl_->report; }
bool Device::has_ray_query() const { return impl_->ray_query; }
bool Device::has_addresses() const { return impl_->report.has_addresses; }
bool Device::is_software() const { return impl_->report.is_software; }
const DeviceLimits& Device::limits() const { return impl_->limits; }
const DeviceOptions& Device::options() const { return impl_->options; }
std::uint64_t Device::validation_messages() const { return impl_->instance->validation().count(); }
std::uint64_t Device::allocated_bytes() const { return impl_->allocated_bytes; }
VkInstance Device::instance() const { return impl_->instance->handle(); }
VkPhysicalDevice Device::physical() const { return impl_->physical; }
VkDevice Device::handle() const { return impl_->device; }
VkQueue Device::queue() const { return impl_->queue; }
std::uint32_t Device::queue_family() const { return impl_->queue_family; }

Device::Impl::Recording& Device::Impl::recording_at(std::size_t at) {
  if (at == recordings.size()) recordings.emplace_back();
  Recording& recording = recordings[at];
  if (!recording.commands) {
    auto allocate = vk_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    FB_VK(vkAllocateCommandBuffers(device, &allocate, &recording.commands));
  }
  if (!recording.fence) {
    auto fence = vk_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    FB_VK(vkCreateFence(device, &fence, nullptr, &recording.fence));
  }
  return recording;
}

void Device::Impl::drop(Recording& recording) {
  vkDeviceWaitIdle(device);
  vkResetCommandBuffer(recording.commands, 0);
  // Nobody knows whether it is signalled.
  vkDestroyFence(device, recording.fence, nullptr);
  recording.fence = VK_NULL_HANDLE;
}

// A recording in use. If it is not finished, whatever became of it is waited for and dropped.
class Device::Impl::Run {
 public:
  explicit Run(Impl& device) : device_(device), at_(device.depth) {
    device.recording_at(at_);
    ++device.depth;
  }
  ~Run() {
    --device_.depth;
    if (!finished_) device_.drop(recording());
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  Recording& recording() const { return device_.recordings[at_]; }
  void finish() { finished_ = true; }

 private:
  Impl& device_;
  std::size_t at_;
  bool finished_ = false;
};

void Device::Impl::submit(Device& owner, Run& run, const std::function<void(Commands&)>& record) {
  const VkCommandBuffer cmd = run.recording().commands;
  auto begin = vk_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  FB_VK(vkBeginCommandBuffer(cmd, &begin));
  Commands commands(owner, cmd);
  record(commands);
  // The fence alone does not make the device's writes visible to the host.
  auto to_host = vk_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  to_host.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr,
                       0, nullptr);
  FB_VK(vkEndCommandBuffer(cmd));

  auto info = vk_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &cmd;
  leave_driver_room();
  FB_VK(vkQueueSubmit(queue, 1, &info, run.recording().fence));
}

void Device::Impl::wait_for(Recording& recording) {
  FB_VK(vkWaitForFences(device, 1, &recording.fence, VK_TRUE, UINT64_MAX));
  FB_VK(vkResetFences(device, 1, &recording.fence));
}

void Device::run(const std::function<void(Commands&)>& record) {
  finish();
  Impl::Run run(*impl_);
  impl_->submit(*this, run, record);
  impl_->wait_for(run.recording());
  run.finish();
}

void Device::start(const std::function<void(Commands&)>& record) {
  finish();
  FB_CHECK_EQ(impl_->depth, std::size_t{0});
  Impl::Run run(*impl_);
  impl_->submit(*this, run, record);
  run.finish();
  impl_->started = true;
}

void Device::finish() {
  if (!std::exchange(impl_->started, false)) return;
  try {
    impl_->wait_for(impl_->recordings[0]);
  } catch (...) {
    impl_->drop(impl_->recordings[0]);
    throw;
  }
}

void Device::settle() noexcept {
  if (impl_->started) vkDeviceWaitIdle(impl_->device);
}

}  // namespace fb::gpu
