// A key of what is seen: equal for what looks the same.
#pragma once

#include <cstdint>

#include "scene/snapshot.h"

namespace fb::lab {

// Everything of a snapshot but its frame number, and the contents of its assets.
std::uint64_t content_key(const scene::FrameSnapshot& snapshot);

}  // namespace fb::lab
