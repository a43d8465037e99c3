// What is known of the distances from which light came in a medium (Shaders/lib/medium_distances.glsl): two halves
// behind the radiance, the former frame's and this one's in turns.
#pragma once

#include <cstdint>

#include "shared/frame.h"
#include "shared/scene_gpu.h"

namespace fb::render {

class MediumDistances {
 public:
  // Paths begin in a medium in this frame.
  static bool scatters(const shared::FrameConstants& c) {
    return (c.medium.w + c.camera_fog_square > 0 || c.turbid != 0) && c.bounces > 0;
  }
  // Says where both halves are, after the medium's blocks are known. A cut leaves nothing of the past.
  void fill(shared::FrameConstants& c, bool cut) {
    c.distances_former = block_ == c.medium_block && !cut ? half_ : shared::kNoIndex;
    half_ ^= 1u;
    c.distances_now = half_;
    block_ = scatters(c) ? c.medium_block : 0;
  }
  void forget() { block_ = 0; }

 private:
  std::uint32_t half_ = 0, block_ = 0;  // pixels a side of the former frame's blocks; 0: nothing is known
};

}  // namespace fb::render
