// FrameDrawer: draws frames at the requested size and settings. If there is no memory for them, it draws with those of
// the last frame, prints one message, and tries again when the request changes.
#pragma once

#include <optional>

#include "base/maths.h"
#include "render/renderer.h"

namespace fb::host {

class FrameDrawer {
 public:
  explicit FrameDrawer(render::Renderer& renderer) : renderer_(renderer) {}

  void resize(uvec2 size) { size_ = size; }
  // Size of the frame that draw() would draw with these settings; 2D elements are laid out for it.
  uvec2 size(const render::RenderSettings& settings) const;
  // Begins the frame (Renderer::begin). Throws std::bad_alloc if there is no memory for the scene.
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
