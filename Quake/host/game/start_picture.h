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
  // Over `under`, if it has the swapchain's size, else over black. What cannot be shown is not: the picture is a help,
  // no more.
  void show(gpu::Device& device, gpu::Swapchain& swapchain, const scene::DrawList& list,
            const lab::FilmFrame& under = {});
  void release() { pixels_.reset(); }

 private:
  std::optional<gpu::Buffer> pixels_;  // mapped
  lab::FilmFrame frame_;
};

}  // namespace fb::host
