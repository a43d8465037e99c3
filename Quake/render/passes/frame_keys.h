// When two frames are of the same thing, and are made in the same way.
#pragma once

#include <cstdint>

#include "render/passes/settings.h"
#include "scene/snapshot.h"

namespace fb::render {

// A hash of everything in a snapshot that may move: equal, nothing has.
std::uint64_t scene_key(const scene::FrameSnapshot& snapshot);
// Of how the sky looks, with its suns, continuing `key`.
std::uint64_t sky_key(const scene::Sky& sky, std::uint64_t key);

// Of every row of the settings, each in its own type with its cvar's name, and of the estimator's name.
std::uint64_t settings_key(const RenderSettings& settings, std::uint64_t seed = 0);

// The scene's with that of the settings: frames of equal keys may be averaged.
std::uint64_t view_key(std::uint64_t scene, const RenderSettings& settings);

}  // namespace fb::render
