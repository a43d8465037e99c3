// One picture at a time: acquire, copy the pixels in, present, wait. The picture took the device far longer to make
// than the copy takes, so nothing would be gained by more in flight.
#include "gpu/swapchain.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/out_of_memory.h"
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
  // Where memory runs out nothing is left but the surface, and the next make() begins anew.
  Status make(std::uint32_t width, std::uint32_t height);
  bool present(const Picture& picture);

  Status make_images(std::uint32_t width, std::uint32_t height);
  void make_recording();
  void forget_images();
  void forget_all();
  void record_copy(const Picture& picture, VkImage image);
  bool copy_and_present(const Picture& picture);

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
  forget_all();
  vkDestroySurfaceKHR(device.instance(), surface, nullptr);
}

void Swapchain::Impl::forget_images() {
  for (VkSemaphore semaphore : copied) vkDestroySemaphore(device.handle(), semaphore, nullptr);
  copied.clear();
  images.clear();
}

void Swapchain::Impl::forget_all() {
  const VkDevice handle = device.handle();
  vkDeviceWaitIdle(handle);
  vkDestroySwapchainKHR(handle, std::exchange(swapchain, VK_NULL_HANDLE), nullptr);
  forget_images();
  vkDestroySemaphore(handle, std::exchange(acquired, VK_NULL_HANDLE), nullptr);
  vkDestroyFence(handle, std::exchange(fence, VK_NULL_HANDLE), nullptr);
  vkDestroyCommandPool(handle, std::exchange(pool, VK_NULL_HANDLE), nullptr);
  commands = VK_NULL_HANDLE;
}

Status Swapchain::Impl::make(std::uint32_t width, std::uint32_t height) {
  try {
    if (Status made = make_images(width, height); !made) return made;
    make_recording();
    return ok_status();
  } catch (const std::bad_alloc& failure) {
    forget_all();
    return Error{"the window's swapchain could not be made: " + sentence_of(failure)};
  }
}

Status Swapchain::Impl::make_images(std::uint32_t width, std::uint32_t height) {
  const VkPhysicalDevice physical = device.physical();
  VkBool32 presents = VK_FALSE;
  if (FB_VK_TRY(vkGetPhysicalDeviceSurfaceSupportKHR(physical, device.queue_family(), surface, &presents)) !=
          VK_SUCCESS ||
      !presents)
    return Error{fmt::format("{} cannot show pictures in this window", device.report().name)};
  VkSurfaceCapabilitiesKHR can;
  const VkResult asked = FB_VK_TRY(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical, surface, &can));
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
  const VkResult result = FB_VK_TRY(vkCreateSwapchainKHR(device.handle(), &info, nullptr, &made));
  vkDestroySwapchainKHR(device.handle(), std::exchange(swapchain, VK_NULL_HANDLE), nullptr);
  forget_images();
  if (result != VK_SUCCESS) return Error{"the window's swapchain could not be made: " + result_name(result)};
  swapchain = made;
  extent = size;
  std::uint32_t count = 0;
  FB_VK(vkGetSwapchainImagesKHR(device.handle(), swapchain, &count, nullptr));
  images.resize(count);
  FB_VK(vkGetSwapchainImagesKHR(device.handle(), swapchain, &count, images.data()));
  copied.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) copied.push_back(make_semaphore(device.handle()));
  return ok_status();
}

// What every copy uses, made once.
void Swapchain::Impl::make_recording() {
  const VkDevice handle = device.handle();
  if (!acquired) acquired = make_semaphore(handle);
  if (!fence) {
    auto info = vk_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    FB_VK(vkCreateFence(handle, &info, nullptr, &fence));
  }
  if (!pool) {
    auto info = vk_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    info.queueFamilyIndex = device.queue_family();
    FB_VK(vkCreateCommandPool(handle, &info, nullptr, &pool));
  }
  if (!commands) {
    auto allocate = vk_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    FB_VK(vkAllocateCommandBuffers(handle, &allocate, &commands));
  }
}

void Swapchain::Impl::record_copy(const Picture& picture, VkImage image) {
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
  if (picture.width < extent.width || picture.height < extent.height) {
    const VkClearColorValue black{};
    vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &to.subresourceRange);
    VkImageMemoryBarrier cleared = to;
    cleared.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    cleared.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &cleared);
  }
  VkBufferImageCopy region{};
  region.bufferRowLength = picture.width;
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {std::min(picture.width, extent.width), std::min(picture.height, extent.height), 1};
  vkCmdCopyBufferToImage(commands, picture.pixels->handle(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  VkImageMemoryBarrier shown = to;
  shown.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  shown.dstAccessMask = 0;  // the semaphore makes it visible to presentation
  shown.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  shown.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 0,
                       nullptr, 1, &shown);
  FB_VK(vkEndCommandBuffer(commands));
}

bool Swapchain::Impl::present(const Picture& picture) {
  if (!swapchain) return false;
  try {
    return copy_and_present(picture);
  } catch (const std::bad_alloc&) {
    forget_all();  // an image may be acquired, a semaphore signalled
    throw;
  }
}

bool Swapchain::Impl::copy_and_present(const Picture& picture) {
  FB_CHECK_LE(VkDeviceSize{picture.width} * picture.height * 4, picture.pixels->size());
  std::uint32_t index = 0;
  VkResult result =
      FB_VK_TRY(vkAcquireNextImageKHR(device.handle(), swapchain, UINT64_MAX, acquired, VK_NULL_HANDLE, &index));
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR) return false;
  check_result(result, "vkAcquireNextImageKHR", __FILE__, __LINE__);
  record_copy(picture, images[index]);

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
  result = FB_VK_TRY(vkQueuePresentKHR(device.queue(), &info));
  FB_VK(vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, UINT64_MAX));
  FB_VK(vkResetFences(device.handle(), 1, &fence));
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR) return false;
  check_result(result, "vkQueuePresentKHR", __FILE__, __LINE__);
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
  return std::unique_ptr<Swapchain>(new Swapchain(std::move(impl)));
}

Swapchain::Swapchain(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Swapchain::~Swapchain() = default;
std::uint32_t Swapchain::width() const { return impl_->extent.width; }
std::uint32_t Swapchain::height() const { return impl_->extent.height; }
bool Swapchain::swaps_red_and_blue() const { return impl_->format == VK_FORMAT_B8G8R8A8_UNORM; }
bool Swapchain::present(const Picture& picture) { return impl_->present(picture); }
Status Swapchain::resize(std::uint32_t width, std::uint32_t height) { return impl_->make(width, height); }

}  // namespace fb::gpu
