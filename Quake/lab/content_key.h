// Keys of what is rendered: equal for what looks the same.
#pragma once

#include <cstdint>

#include "render/passes/settings.h"
#include "scene/snapshot.h"

namespace fb::lab {

// Everything of a snapshot but its frame number, and the contents of its assets.
std::uint64_t content_key(const scene::FrameSnapshot& snapshot);
// Every setting, and the estimator's name.
std::uint64_t settings_key(const render::RenderSettings& settings);

}  // namespace fb::lab
