// 2D drawing on the device: quads and atlas uploaded, quads binned into tiles of the output in drawing order.
#pragma once

#include "gpu/buffer.h"
#include "gpu/pipeline.h"
#include "render/passes/pass.h"
#include "scene/draw_list.h"

namespace fb::render {

class Overlay {
 public:
  Overlay(gpu::Device& device, gpu::BindingTable& table);
  // Between submissions. `list` may be null. Of more than the device's buffers hold, what is at the bottom is left out.
  void prepare(const scene::DrawList* list, std::uint32_t width, std::uint32_t height);
  // The frame's last pass, which draws the 2D over the picture.
  void add_present(PassList& list, const gpu::ComputePipeline& present, uvec2 output);
  bool empty() const { return empty_; }
  std::uint32_t tiles_x() const { return tiles_x_; }
  std::uint32_t atlas_width() const { return atlas_width_; }

 private:
  void bind();
  std::uint32_t first_that_fits(const scene::DrawList& list, std::uint32_t width, std::uint32_t height,
                                std::size_t tile_count);

  gpu::Device& device_;
  gpu::BindingTable& table_;
  gpu::Buffer quads_, tiles_, atlas_;
  std::uint64_t atlas_revision_ = 0;
  std::uint32_t atlas_width_ = 1, tiles_x_ = 1;
  bool empty_ = true, said_too_many_ = false;
};

}  // namespace fb::render
