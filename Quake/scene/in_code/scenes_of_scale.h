// Scenes made in code whose cost grows with a number: how the renderer's time scales with triangles and moving things.
// many_lights() is their like for lights.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/snapshot.h"

namespace fb::scene {

// A hall of 1024 x 1024 x 256 with one lamp and a floor of small waves in one mesh, `count` triangles in all, to a
// row of them. At least 100.
FrameSnapshot many_triangles(std::uint32_t count);

// The same hall with `count` boxes that circle at their own speeds, each an instance of its own. Snapshots that share
// `assets` are frames of one film; times in seconds.
std::shared_ptr<const Assets> many_movers_assets();
FrameSnapshot many_movers(const std::shared_ptr<const Assets>& assets, std::uint32_t count, double time,
                          double prev_time);

}  // namespace fb::scene
