// A window's swapchain. Pictures come as a storage buffer of packed 8-bit pixels, copied into the acquired image.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>

#include "gpu/buffer.h"
#include "gpu/device.h"

namespace fb::gpu {

class Swapchain {
 public:
  // Packed 8-bit pixels, row by row.
  struct Picture {
    const Buffer* pixels = nullptr;
    std::uint32_t width = 0, height = 0;
  };
  // Takes the surface, also if it fails. Formats: B8G8R8A8 or R8G8B8A8 (UNORM); see swaps_red_and_blue.
  static Result<std::unique_ptr<Swapchain>> create(Device& device, VkSurfaceKHR surface, std::uint32_t width,
                                                   std::uint32_t height, bool vsync);
  ~Swapchain();
  std::uint32_t width() const;
  std::uint32_t height() const;
  // True: the pixel's lowest byte is blue.
  bool swaps_red_and_blue() const;
  // Makes the images anew for the window's present size (the arguments count only where the window system leaves the
  // size to us). Fails while the window has no area (minimised): then present() shows nothing until it succeeds.
  Status resize(std::uint32_t width, std::uint32_t height);
  // Shows the picture and waits for the copy; what is larger than the window is cut off, what is smaller leaves black.
  // False: out of date, so resize(). Throws OutOfMemory; resize() then begins anew.
  bool present(const Picture& picture);

 private:
  struct Impl;
  explicit Swapchain(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::gpu
