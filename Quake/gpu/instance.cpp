#include "gpu/instance.h"

#include <fmt/format.h>

#include <cstring>
#include <vector>

#include "base/log.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

#if defined(__SANITIZE_ADDRESS__)
#define FB_KEEP_DRIVERS_LOADED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FB_KEEP_DRIVERS_LOADED
#endif
#endif

namespace fb::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoDriver =
    "no Vulkan driver was found: install the graphics card's, or Mesa's software driver (Debian: mesa-vulkan-drivers)";

std::vector<VkExtensionProperties> instance_extensions(const char* layer) {
  std::uint32_t count = 0;
  std::vector<VkExtensionProperties> list;
  const auto enumerate = [&](VkExtensionProperties* into) {
    const VkResult result = FB_VK_TRY(vkEnumerateInstanceExtensionProperties(layer, &count, into));
    throw_if_out_of_memory(result, "vkEnumerateInstanceExtensionProperties");
    if (result < 0) count = 0;
  };
  enumerate(nullptr);
  list.resize(count);
  enumerate(list.data());
  list.resize(count);
  return list;
}

bool contains(const std::vector<VkExtensionProperties>& list, const char* name) {
  for (const auto& extension : list)
    if (std::strcmp(extension.extensionName, name) == 0) return true;
  return false;
}

bool has_validation_layer() {
  std::uint32_t count = 0;
  std::vector<VkLayerProperties> layers;
  const auto enumerate = [&](VkLayerProperties* into) {
    const VkResult result = FB_VK_TRY(vkEnumerateInstanceLayerProperties(&count, into));
    throw_if_out_of_memory(result, "vkEnumerateInstanceLayerProperties");
    if (result < 0) count = 0;
  };
  enumerate(nullptr);
  layers.resize(count);
  enumerate(layers.data());
  layers.resize(count);
  for (const auto& layer : layers)
    if (std::strcmp(layer.layerName, kValidationLayer) == 0) return true;
  return false;
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const bool is_error = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  static_cast<ValidationLog*>(user)->add(is_error, data->pMessage ? data->pMessage : "(no text)");
  return VK_FALSE;
}

// Not the loader's general messages: they are about drivers that could not be loaded, not about us.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  auto info = vk_struct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = &log;
  return info;
}

// What the instance is to be made of.
struct InstanceRequest {
  std::vector<const char*> layers, extensions;
  bool debug_utils = false;
  bool synchronization = false;
};

Result<InstanceRequest> make_request(const DeviceOptions& options) {
  InstanceRequest request;
  request.extensions = options.instance_extensions;
  const auto offered = instance_extensions(nullptr);
  for (const char* name : request.extensions)
    if (!contains(offered, name)) return Error{fmt::format("the Vulkan loader offers no {}: {}", name, kNoDriver)};
  request.debug_utils = contains(offered, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (options.validation && !has_validation_layer()) {
    log_warning("{} is not installed: Vulkan calls are not validated (Debian: vulkan-validationlayers)",
                kValidationLayer);
  } else if (options.validation) {
    request.layers.push_back(kValidationLayer);
    const auto of_layer = instance_extensions(kValidationLayer);
    request.debug_utils |= contains(of_layer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    request.synchronization =
        options.synchronization_validation && contains(of_layer, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  if (request.synchronization) request.extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  if (request.debug_utils) request.extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  return request;
}

VkResult make_instance(const InstanceRequest& request, const VkDebugUtilsMessengerCreateInfoEXT* messenger,
                       VkInstance* instance) {
  auto application = vk_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "Fullbright";
  application.pEngineName = "Fullbright";
  application.apiVersion = VK_API_VERSION_1_2;
  auto info = vk_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<std::uint32_t>(request.layers.size());
  info.ppEnabledLayerNames = request.layers.data();
  info.enabledExtensionCount = static_cast<std::uint32_t>(request.extensions.size());
  info.ppEnabledExtensionNames = request.extensions.data();
  info.pNext = messenger;

  const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  auto features = vk_struct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enables;
  if (request.synchronization) {
    features.pNext = info.pNext;
    info.pNext = &features;
  }
  return FB_VK_TRY(vkCreateInstance(&info, nullptr, instance));
}

}  // namespace

void ValidationLog::add(bool is_error, const std::string& text) {
  ++count_;
  {
    std::lock_guard lock(mutex_);
    if (!seen_.insert(text).second) return;
  }
  log_line(is_error ? LogLevel::kError : LogLevel::kWarning, "Vulkan validation: " + text);
}

Result<std::unique_ptr<Instance>> Instance::create(const DeviceOptions& options) {
  std::uint32_t version = VK_API_VERSION_1_0;
  if (vkEnumerateInstanceVersion(&version) != VK_SUCCESS || version < VK_API_VERSION_1_2)
    return Error{"the Vulkan loader is older than 1.2: install a newer one (Debian: libvulkan1)"};
  auto request = make_request(options);
  if (!request) return request.error();

  std::unique_ptr<Instance> made(new Instance);
  made->has_debug_utils_ = request->debug_utils;
  // In the instance's chain the messenger also hears of the instance's own making and end.
  auto messenger = messenger_info(made->validation_);
  const bool listens = !request->layers.empty() && request->debug_utils;
  const VkResult result = make_instance(*request, listens ? &messenger : nullptr, &made->handle_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return Error{kNoDriver};
  if (result != VK_SUCCESS) return Error{"Vulkan could not be started: vkCreateInstance gave " + result_name(result)};
#ifdef FB_KEEP_DRIVERS_LOADED
  // A leak in a driver or layer that has been unloaded has no name by which it could be told from ours.
  static VkInstance kept[2] = {};
  VkInstance& keep = kept[request->layers.empty() ? 0 : 1];
  if (!keep) FB_VK(make_instance(*request, nullptr, &keep));
#endif
  if (listens) {
    const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(made->handle_, "vkCreateDebugUtilsMessengerEXT"));
    if (create_messenger) FB_VK(create_messenger(made->handle_, &messenger, nullptr, &made->messenger_));
  }
  return made;
}

Instance::~Instance() {
  if (messenger_) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
    if (destroy) destroy(handle_, messenger_, nullptr);
  }
  if (handle_) vkDestroyInstance(handle_, nullptr);
}

}  // namespace fb::gpu
