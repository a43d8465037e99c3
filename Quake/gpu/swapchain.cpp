// One picture at a time: acquire, copy the pixels in, present, wait. The picture took the device far longer to make
// than the copy takes, so nothing would be gained by more in flight.
#include "gpu/swapchain.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "gpu/device_impl.h"
#include "gpu/vulkan_error.h"
#include "gpu/vulkan_struct.h"

namespace fb::gpu {
namespace {

// Four bytes a pixel that are stored as they come. The surface's colour space is left at sRGB.
VkFormat choose_format(VkPhysicalDevice physical, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  FB_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, nullptr));
  std::vector<VkSurfaceFormatKHR> formats(count);
  FB_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, formats.data()));
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
    for (const VkSurfaceFormatKHR& offered : formats)
      if (offered.format == wanted && offered.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return wanted;
  return VK_FORMAT_UNDEFINED;
}

// First in, first out waits for the screen; every device has it.
VkPresentModeKHR choose_mode(VkPhysicalDevice physical, VkSurfaceKHR surface, bool vsync) {
  if (vsync) return VK_PRESENT_MODE_FIFO_KHR;
  std::uint32_t count = 0;
  FB_VK(vkGetPhysicalDeviceSurfacePresentModesKHR(physical, surface, &count, nullptr));
  std::vector<VkPresentModeKHR> modes(count);
  FB_VK(vkGetPhysicalDeviceSurfacePresentModesKHR(physical, surface, &count, modes.data()));
  for (const VkPresentModeKHR wanted : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
    if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) return wanted;
  return VK_PRESENT_MODE_FIFO_KHR;
}

VkSemaphore make_semaphore(VkDevice device) {
  auto info = vk_struct<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
  VkSemaphore semaphore = VK_NULL_HANDLE;
  FB_VK(vkCreateSemaphore(device, &info, nullptr, &semaphore));
  return semaphore;
}

}  // namespace

struct Swapchain::Impl {
  Impl(Device& d, VkSurfaceKHR s, bool v) : device(d), surface(s), vsync(v) {}
  ~Impl();
  Status make(std::uint32_t width, std::uint32_t height);
  void forget_images();
  void record_copy(const Buffer& pixels, VkImage image);
  bool present(const Buffer& pixels);

  Device& device;
  VkSurfaceKHR surface;
  bool vsync;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D extent{};
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  std::vector<VkImage> images;
  std::vector<VkSemaphore> copied;  // one an image: presentation may still wait on another's
  VkSemaphore acquired = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
};

Swapchain::Impl::~Impl() {
  vkDeviceWaitIdle(device.handle());
  forget_images();
  if (swapchain) vkDestroySwapchainKHR(device.handle(), swapchain, nullptr);
  if (acquired) vkDestroySemaphore(device.handle(), acquired, nullptr);
  if (fence) vkDestroyFence(device.handle(), fence, nullptr);
  if (pool) vkDestroyCommandPool(device.handle(), pool, nullptr);
  vkDestroySurfaceKHR(device.instance(), surface, nullptr);
}

void Swapchain::Impl::forget_images() {
  for (VkSemaphore semaphore : copied) vkDestroySemaphore(device.handle(), semaphore, nullptr);
  copied.clear();
  images.clear();
}

Status Swapchain::Impl::make(std::uint32_t width, std::uint32_t height) {
  const VkPhysicalDevice physical = device.physical();
  VkBool32 presents = VK_FALSE;
  if (vkGetPhysicalDeviceSurfaceSupportKHR(physical, device.queue_family(), surface, &presents) != VK_SUCCESS ||
      !presents)
    return Error{fmt::format("{} cannot show pictures in this window", device.report().name)};
  VkSurfaceCapabilitiesKHR can;
  const VkResult asked = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical, surface, &can);
  if (asked != VK_SUCCESS) return Error{"the window's surface is gone: " + result_name(asked)};
  if (!(can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
    return Error{fmt::format("{} cannot copy pictures into this window", device.report().name)};
  format = choose_format(physical, surface);
  if (format == VK_FORMAT_UNDEFINED)
    return Error{fmt::format("{} offers no 8-bit format for this window", device.report().name)};

  VkExtent2D size = can.currentExtent;
  if (size.width == UINT32_MAX) {  // the swapchain decides
    size.width = std::clamp(width, can.minImageExtent.width, can.maxImageExtent.width);
    size.height = std::clamp(height, can.minImageExtent.height, can.maxImageExtent.height);
  }
  if (size.width == 0 || size.height == 0) return Error{"the window has no area now"};

  vkDeviceWaitIdle(device.handle());
  auto info = vk_struct<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
  info.surface = surface;
  info.minImageCount = can.minImageCount + 1;
  if (can.maxImageCount) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
  info.imageFormat = format;
  info.imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  info.imageExtent = size;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = can.currentTransform;
  info.compositeAlpha = (can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR)
                            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = choose_mode(physical, surface, vsync);
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain;
  VkSwapchainKHR made = VK_NULL_HANDLE;
  const VkResult result = vkCreateSwapchainKHR(device.handle(), &info, nullptr, &made);
  if (swapchain) vkDestroySwapchainKHR(device.handle(), swapchain, nullptr);
  swapchain = made;
  forget_images();
  if (result != VK_SUCCESS) {
    swapchain = VK_NULL_HANDLE;
    return Error{"the window's swapchain could not be made: " + result_name(result)};
  }
  extent = size;
  std::uint32_t count = 0;
  FB_VK(vkGetSwapchainImagesKHR(device.handle(), swapchain, &count, nullptr));
  images.resize(count);
  FB_VK(vkGetSwapchainImagesKHR(device.handle(), swapchain, &count, images.data()));
  for (std::uint32_t i = 0; i < count; ++i) copied.push_back(make_semaphore(device.handle()));
  return ok_status();
}

void Swapchain::Impl::record_copy(const Buffer& pixels, VkImage image) {
  auto begin = vk_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  FB_VK(vkBeginCommandBuffer(commands, &begin));
  auto to = vk_struct<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  to.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  to.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  to.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  to.srcQueueFamilyIndex = to.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  to.image = image;
  to.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                       nullptr, 1, &to);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyBufferToImage(commands, pixels.handle(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  VkImageMemoryBarrier shown = to;
  shown.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  shown.dstAccessMask = 0;  // the semaphore makes it visible to presentation
  shown.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  shown.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 0,
                       nullptr, 1, &shown);
  FB_VK(vkEndCommandBuffer(commands));
}

bool Swapchain::Impl::present(const Buffer& pixels) {
  if (!swapchain) return false;
  FB_CHECK_LE(VkDeviceSize{extent.width} * extent.height * 4, pixels.size());
  std::uint32_t index = 0;
  VkResult result = vkAcquireNextImageKHR(device.handle(), swapchain, UINT64_MAX, acquired, VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR) return false;
  FB_VK(result);
  record_copy(pixels, images[index]);

  const VkPipelineStageFlags wait_stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
  auto submit = vk_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.waitSemaphoreCount = 1;
  submit.pWaitSemaphores = &acquired;
  submit.pWaitDstStageMask = &wait_stage;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &copied[index];
  FB_VK(vkQueueSubmit(device.queue(), 1, &submit, fence));
  auto info = vk_struct<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &copied[index];
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain;
  info.pImageIndices = &index;
  result = vkQueuePresentKHR(device.queue(), &info);
  FB_VK(vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, UINT64_MAX));
  FB_VK(vkResetFences(device.handle(), 1, &fence));
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR) return false;
  FB_VK(result);
  // Asked each time: some drivers never say that the window's size has changed, others call a swapchain suboptimal for
  // good whatever its size.
  VkSurfaceCapabilitiesKHR can;
  if (vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical(), surface, &can) != VK_SUCCESS) return false;
  return can.currentExtent.width == UINT32_MAX ||
         (can.currentExtent.width == extent.width && can.currentExtent.height == extent.height);
}

Result<std::unique_ptr<Swapchain>> Swapchain::create(Device& device, VkSurfaceKHR surface, std::uint32_t width,
                                                     std::uint32_t height, bool vsync) {
  auto impl = std::make_unique<Impl>(device, surface, vsync);
  if (const Status made = impl->make(width, height); !made) return made.error();
  const VkDevice handle = device.handle();
  impl->acquired = make_semaphore(handle);
  auto fence = vk_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  FB_VK(vkCreateFence(handle, &fence, nullptr, &impl->fence));
  auto pool = vk_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = device.queue_family();
  FB_VK(vkCreateCommandPool(handle, &pool, nullptr, &impl->pool));
  auto allocate = vk_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocate.commandPool = impl->pool;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  FB_VK(vkAllocateCommandBuffers(handle, &allocate, &impl->commands));
  return std::unique_ptr<Swapchain>(new Swapchain(std::move(impl)));
}

Swapchain::Swapchain(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Swapchain::~Swapchain() = default;
std::uint32_t Swapchain::width() const { return impl_->extent.width; }
std::uint32_t Swapchain::height() const { return impl_->extent.height; }
bool Swapchain::swaps_red_and_blue() const { return impl_->format == VK_FORMAT_B8G8R8A8_UNORM; }
bool Swapchain::present(const Buffer& pixels) { return impl_->present(pixels); }
Status Swapchain::resize(std::uint32_t width, std::uint32_t height) { return impl_->make(width, height); }

}  // namespace fb::gpu
