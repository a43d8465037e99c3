// What a frame's instances may take of the device's arrays, and which of them are drawn where all would take more:
// those that are nearest.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fb::render {

// Items of each array: what there is, or what one instance takes.
struct SceneRoom {
  std::uint64_t instances = 1, copies = 0, triangles = 0, nodes = 0, vertices = 0;
  bool holds(const SceneRoom& other) const {
    return other.instances <= instances && other.copies <= copies && other.triangles <= triangles &&
           other.nodes <= nodes && other.vertices <= vertices;
  }
  void add(const SceneRoom& other);
  void take(const SceneRoom& other);  // which it holds
};

struct SceneDemand {
  SceneRoom room;
  float distance = 0.0f;
};

// Which instances are drawn: from near to far (equals in the list's order), each that still fits.
std::vector<bool> nearest_that_fit(std::span<const SceneDemand> demands, SceneRoom room);

}  // namespace fb::render
