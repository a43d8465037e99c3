#include "gpu/device_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>
#include <system_error>

#include "base/number.h"
#include "gpu/pipeline.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

// The shaders' largest workgroup; Vulkan promises 128.
constexpr std::uint32_t kWorkgroupInvocations = 256;

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

int type_rank(std::string_view type) {
  constexpr std::string_view kOrder[] = {"discrete", "integrated", "virtual", "cpu"};
  return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), type) - std::begin(kOrder));
}

std::vector<VkExtensionProperties> device_extensions(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  std::vector<VkExtensionProperties> list;
  const auto enumerate = [&](VkExtensionProperties* into) {
    const VkResult result = FB_VK_TRY(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, into));
    throw_if_out_of_memory(result, "vkEnumerateDeviceExtensionProperties");
    if (result < 0) count = 0;
  };
  enumerate(nullptr);
  list.resize(count);
  enumerate(list.data());
  list.resize(count);
  return list;
}

bool has_extension(const std::vector<VkExtensionProperties>& list, const char* name) {
  return std::any_of(list.begin(), list.end(), [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool has_buffer_addresses(VkPhysicalDevice device) {
  auto core = vk_struct<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  auto features = vk_struct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  features.pNext = &core;
  vkGetPhysicalDeviceFeatures2(device, &features);
  return core.bufferDeviceAddress == VK_TRUE;
}

// What stands between the device and ray queries; empty if nothing does. An extension may be there with its feature
// bit off, so both are asked.
std::string why_no_ray_query(VkPhysicalDevice device, const std::vector<VkExtensionProperties>& extensions) {
  for (const char* name : {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                           VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME})
    if (!has_extension(extensions, name)) return fmt::format("no {}", name);
  auto query = vk_struct<VkPhysicalDeviceRayQueryFeaturesKHR>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);
  auto structure = vk_struct<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
  auto core = vk_struct<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  auto features = vk_struct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  features.pNext = &core;
  core.pNext = &structure;
  structure.pNext = &query;
  vkGetPhysicalDeviceFeatures2(device, &features);
  if (!query.rayQuery) return "VK_KHR_ray_query is there, its feature rayQuery is not";
  if (!structure.accelerationStructure)
    return "VK_KHR_acceleration_structure is there, its feature accelerationStructure is not";
  if (!core.bufferDeviceAddress) return "no bufferDeviceAddress";
  return {};
}

// The family that computes, best one that draws as well.
std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice device, bool must_draw, std::uint32_t& timestamp_bits) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (const VkQueueFlags wanted :
       {VkQueueFlags{VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT}, VkQueueFlags{VK_QUEUE_COMPUTE_BIT}}) {
    if (must_draw && !(wanted & VK_QUEUE_GRAPHICS_BIT)) continue;
    for (std::uint32_t i = 0; i < families.size(); ++i) {
      if ((families[i].queueFlags & wanted) != wanted || families[i].queueCount == 0) continue;
      timestamp_bits = families[i].timestampValidBits;
      return i;
    }
  }
  return std::nullopt;
}

PhysicalDevice examine(VkPhysicalDevice handle, const DeviceOptions& options) {
  PhysicalDevice device;
  device.handle = handle;
  DeviceReport& report = device.report;
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(handle, &properties);
  report.name = properties.deviceName;
  report.type = type_name(properties.deviceType);
  report.is_software = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  if (properties.apiVersion < VK_API_VERSION_1_2) {
    report.driver = fmt::format("version {:#x}", properties.driverVersion);
    report.lacks.push_back(fmt::format("Vulkan {}.{} only, 1.2 is needed: unusable",
                                       VK_API_VERSION_MAJOR(properties.apiVersion),
                                       VK_API_VERSION_MINOR(properties.apiVersion)));
    return device;
  }
  auto core = vk_struct<VkPhysicalDeviceVulkan12Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES);
  auto properties2 = vk_struct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties2.pNext = &core;
  vkGetPhysicalDeviceProperties2(handle, &properties2);
  report.driver = fmt::format("{} {}", core.driverName, core.driverInfo);

  report.usable = true;
  const auto unusable = [&](std::string why) {
    report.usable = false;
    report.lacks.push_back(std::move(why) + ": unusable");
  };
  const VkPhysicalDeviceLimits& limits = properties.limits;
  constexpr std::uint32_t kStorageBuffers = shared::kArraysInPlace;
  if (limits.maxPerStageDescriptorStorageBuffers < kStorageBuffers)
    unusable(fmt::format("{} storage buffers a shader, {} are needed", limits.maxPerStageDescriptorStorageBuffers,
                         kStorageBuffers));
  if (limits.maxComputeWorkGroupInvocations < kWorkgroupInvocations)
    unusable(fmt::format("workgroups of {} at most, {} are needed", limits.maxComputeWorkGroupInvocations,
                         kWorkgroupInvocations));

  const auto extensions = device_extensions(handle);
  const bool can_swap = has_extension(extensions, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  if (const auto family = find_queue_family(handle, options.present, device.timestamp_bits))
    device.queue_family = *family;
  else
    unusable(options.present ? "no queue that computes and presents" : "no queue that computes");
  if (!can_swap && options.present)
    unusable("no VK_KHR_swapchain, so no window");
  else if (!can_swap)
    report.lacks.push_back("no VK_KHR_swapchain: pictures go to files, not to a window");
  if (device.timestamp_bits == 0 || limits.timestampPeriod <= 0)
    report.lacks.push_back("no timestamps: the time of passes shows as zero");

  report.has_addresses = has_buffer_addresses(handle);
  const std::string no_query = why_no_ray_query(handle, extensions);
  report.has_ray_query = no_query.empty();
  if (!report.has_ray_query) report.lacks.push_back(no_query + ": rays are traced by the BVH in the compute shader");
  if (report.is_software) report.lacks.push_back("no graphics hardware: the processor's cores do all the work");
  return device;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string names_of(std::span<const DeviceReport> reports) {
  std::string text;
  for (std::size_t i = 0; i < reports.size(); ++i) text += fmt::format("{}{} {}", i ? ", " : "", i, reports[i].name);
  return text;
}

}  // namespace

std::vector<PhysicalDevice> examine_devices(VkInstance instance, const DeviceOptions& options) {
  std::uint32_t count = 0;
  std::vector<VkPhysicalDevice> handles;
  const auto enumerate = [&](VkPhysicalDevice* into) {
    const VkResult result = FB_VK_TRY(vkEnumeratePhysicalDevices(instance, &count, into));
    throw_if_out_of_memory(result, "vkEnumeratePhysicalDevices");
    return result >= 0;  // else no driver could be started
  };
  if (!enumerate(nullptr)) return {};
  handles.resize(count);
  if (!enumerate(handles.data())) return {};
  handles.resize(count);
  std::vector<PhysicalDevice> devices;
  for (VkPhysicalDevice handle : handles) devices.push_back(examine(handle, options));
  return devices;
}

Result<std::size_t> choose_device(std::span<const DeviceReport> reports, std::string_view preferred) {
  if (reports.empty())
    return Error{
        "no Vulkan device was found: install the graphics card's driver, or Mesa's software driver (Debian: "
        "mesa-vulkan-drivers)"};
  const std::optional<std::uint64_t> index = parse_whole_number_unsigned(preferred);

  std::optional<std::size_t> best, refused;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const bool wanted = index ? i == *index : lower(reports[i].name).find(lower(preferred)) != std::string::npos;
    if (!wanted) continue;
    if (!reports[i].usable)
      refused = i;
    else if (!best || type_rank(reports[i].type) < type_rank(reports[*best].type))
      best = i;
  }
  if (best) return *best;
  if (refused) {
    const auto& lacks = reports[*refused].lacks;
    return Error{fmt::format("Vulkan device {} cannot be used: {}", reports[*refused].name, fmt::join(lacks, "; "))};
  }
  return Error{fmt::format("no Vulkan device is called \"{}\"; there are: {}", preferred, names_of(reports))};
}

}  // namespace fb::gpu
