// The window before the renderer's first picture: drawn by the host, so that it needs no shader.
#pragma once

#include <optional>

#include "gpu/buffer.h"
#include "gpu/swapchain.h"
#include "lab/film/film_frame.h"
#include "scene/draw_list.h"

namespace fb::host {

class StartPicture {
 public:
  // Over black, in the swapchain's size. What cannot be shown is not: the picture is a help, no more.
  void show(gpu::Device& device, gpu::Swapchain& swapchain, const scene::DrawList& list);
  void release() { pixels_.reset(); }

 private:
  std::optional<gpu::Buffer> pixels_;  // mapped
  lab::FilmFrame frame_;
};

}  // namespace fb::host
