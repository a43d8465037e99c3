#include "host/game/start_picture.h"

#include <algorithm>
#include <new>

#include "gpu/vulkan_error.h"
#include "host/film_caption.h"

namespace fb::host {

void StartPicture::show(gpu::Device& device, gpu::Swapchain& swapchain, const scene::DrawList& list,
                        const lab::FilmFrame& under) {
  const uvec2 size(swapchain.width(), swapchain.height());
  if (size.x == 0 || size.y == 0) return;
  try {
    if (!pixels_ || frame_.size != size) {
      frame_.size = size;
      pixels_.emplace(device, gpu::BufferUse::kUpload, std::size_t{size.x} * size.y * sizeof(std::uint32_t),
                      "start picture");
    }
    if (under.size == size && under.pixels.size() == std::size_t{size.x} * size.y)
      frame_.pixels = under.pixels;
    else
      frame_.pixels.assign(std::size_t{size.x} * size.y, 0xff000000u);
    draw_over(frame_, list);
    if (swapchain.swaps_red_and_blue())
      for (std::uint32_t& p : frame_.pixels) p = (p & 0xff00ff00u) | ((p & 0xffu) << 16u) | ((p >> 16u) & 0xffu);
    std::ranges::copy(frame_.pixels, pixels_->mapped_as<std::uint32_t>().begin());
    swapchain.present({&*pixels_, size.x, size.y});
  } catch (const std::bad_alloc&) {
    release();
  } catch (const gpu::DeviceLost&) {  // whoever needs the device says so
  }
}

}  // namespace fb::host
