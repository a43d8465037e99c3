// When two frames are of the same thing.
#pragma once

#include <cstdint>

#include "render/passes/settings.h"
#include "scene/snapshot.h"

namespace fb::render {

// A hash of everything in a snapshot that may move: equal, nothing has.
std::uint64_t scene_key(const scene::FrameSnapshot& snapshot);

// The same with the settings: frames of equal keys may be averaged.
std::uint64_t view_key(std::uint64_t scene, const RenderSettings& settings);

}  // namespace fb::render
