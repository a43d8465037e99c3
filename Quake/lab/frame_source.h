// FrameSource: snapshots of consecutive frames at fixed time steps: what the laboratory renders.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/snapshot.h"

namespace fb::lab {

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  // The next frame's snapshot; false when there are no more (a demo ended).
  virtual Result<bool> next(scene::FrameSnapshot& snapshot) = 0;
};

// A scene made in code by its name (code_scene_names); it never ends. In moving, candles_flicker, rocket and lightsout
// something changes from frame to frame (scene/in_code/scenes_in_motion.h); the others stand still in space and in
// time. "many:N", "triangles:N" and "movers:N" have N lights, about N triangles, N moving boxes.
Result<std::unique_ptr<FrameSource>> code_scene(std::string_view name, double frames_per_second);
std::vector<std::string> code_scene_names();

}  // namespace fb::lab
