// FrameDrawer: draws frames at the size and with the settings that the player asks for, or, where there is no memory
// for these, as the last frame was drawn. It then says so once, and tries again when something else is asked for.
#pragma once

#include <optional>

#include "base/maths.h"
#include "render/renderer.h"

namespace fb::host {

class FrameDrawer {
 public:
  explicit FrameDrawer(render::Renderer& renderer) : renderer_(renderer) {}

  void resize(uvec2 size) { size_ = size; }
  // Of the frame that draw() would draw with these settings: what is 2D is laid out for it.
  uvec2 size(const render::RenderSettings& settings) const;
  // Throws std::bad_alloc where there is no memory for what is to be seen.
  void draw(const scene::FrameSnapshot& snapshot, const scene::DrawList* list, const render::RenderSettings& settings);

 private:
  struct Wish {
    uvec2 size{0, 0};
    render::RenderSettings settings;
    bool operator==(const Wish&) const = default;
  };
  void draw(const scene::FrameSnapshot& snapshot, const scene::DrawList* list, const Wish& wish);

  render::Renderer& renderer_;
  uvec2 size_{640, 360};
  std::optional<Wish> drawn_, refused_;
};

}  // namespace fb::host
