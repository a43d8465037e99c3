// Sticks of a game controller.
#pragma once

#include "base/maths.h"

namespace fb::platform {

struct PadSticks {
  vec2 left{0.0f}, right{0.0f};  // -1 to 1, to the right and downwards
};

}  // namespace fb::platform
