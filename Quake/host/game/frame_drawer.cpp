#include "host/game/frame_drawer.h"

#include <new>

#include "base/log.h"
#include "base/out_of_memory.h"

namespace fb::host {

uvec2 FrameDrawer::size(const render::RenderSettings& settings) const {
  return refused_ && *refused_ == Wish{size_, settings} ? drawn_->size : size_;
}

void FrameDrawer::draw(const scene::FrameSnapshot& snapshot, const scene::DrawList* list, const Wish& wish) {
  renderer_.resize(wish.size.x, wish.size.y);
  renderer_.begin(snapshot, list, wish.settings);
}

void FrameDrawer::draw(const scene::FrameSnapshot& snapshot, const scene::DrawList* list,
                       const render::RenderSettings& settings) {
  const Wish wish{size_, settings};
  if (refused_ && *refused_ == wish) return draw(snapshot, list, *drawn_);
  try {
    draw(snapshot, list, wish);
    drawn_ = wish;
    refused_.reset();
    return;
  } catch (const std::bad_alloc& failure) {
    if (!drawn_ || *drawn_ == wish) throw;
    log_error("{}; the size and settings of the last picture stay, until they are changed again", sentence_of(failure));
  }
  refused_ = wish;
  draw(snapshot, list, *drawn_);
}

}  // namespace fb::host
