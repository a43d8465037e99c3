// Sticks and motion of a game controller.
#pragma once

#include "base/maths.h"

namespace fb::platform {

struct PadSticks {
  vec2 left{0.0f}, right{0.0f};  // -1 to 1, to the right and downwards
  vec3 turned{0.0f};  // by its gyroscope: how far it was turned since it was asked last, degrees: up, to the left, over
                      // to the left
};

}  // namespace fb::platform
